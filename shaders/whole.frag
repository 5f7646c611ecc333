#version 450 core

flat in uint identity;

out uint fragment;

void main() { fragment = identity; }
