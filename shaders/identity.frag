#version 450 core

flat in int identity;

out uint fragment;

void main() { fragment = uint(identity); }
