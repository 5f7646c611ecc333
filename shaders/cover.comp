#version 450 core
// Lights or darkens the samples of masks that convex pieces cover: a row of 32 invocations for each
// piece, view (y) and share of the piece's words (z). As area_in_front() and find_spans() of
// geometry/convex_area.cpp have it, to the bit.

layout(local_size_x = 32, local_size_y = 4) in;

// A mask and a view whose x and y are in its columns and rows. Doubles, as on the CPU.
struct Question {
  dvec4 x;
  dvec4 y;
  dvec4 cut;  // the height above the receiver's plane; w is added where pieces are clipped
  dvec4 origin;
  uint first_word;
  int stride;  // words of a row
  int columns;
  int rows;
  uint first_piece;
  uint pieces;
  uint first_counted;  // of a bit for each caster
  uint unused;
};
struct Piece {
  double corners[12];
  uint caster;
  uint lone;  // 1: it is all of its caster
};
layout(std430, binding = 0) readonly buffer Questions { Question questions[]; };
layout(std430, binding = 1) readonly buffer Pieces { Piece pieces[]; };
layout(std430, binding = 2) readonly buffer Counted { uint counted[]; };
layout(std430, binding = 3) buffer Masks { uint masks[]; };

layout(location = 0) uniform uint lights;  // 1: all pieces light; 0: those counted darken

const double coplanar = 1e-4lf;
// Columns by which an area may be wider than its corners, because spans are in single precision.
const double spare = 1e-2lf;

int first_beyond(double position, int end) {
  return int(clamp(position, 0.0lf, double(end)) + 0.5lf);
}

// The x of an edge at the centre of row 0, and its change per row.
void find_edge(dvec2 from, dvec2 to, bool anticlockwise, out float start, out float slope,
               out int side) {
  start = 0.0;
  slope = 0.0;
  side = 0;
  if (from == to) return;
  bool upwards = from.y < to.y || (from.y == to.y && from.x < to.x);
  dvec2 low = upwards ? from : to;
  dvec2 high = upwards ? to : from;
  precise double change = (high.x - low.x) / max(high.y - low.y, 1e-12lf);
  precise double at_zero = low.x + (0.5lf - low.y) * change;
  start = float(at_zero);
  slope = float(change);
  side = upwards == anticlockwise ? 1 : -1;
}

void cover(Question question, Piece piece) {
  dvec2 place[4];
  double height[4];
  for (int i = 0; i < 4; ++i) {
    precise dvec3 p = dvec3(piece.corners[3 * i], piece.corners[3 * i + 1],
                            piece.corners[3 * i + 2]) - question.origin.xyz;
    precise double x =
        p.x * question.x.x + p.y * question.x.y + p.z * question.x.z + question.x.w;
    precise double y =
        p.x * question.y.x + p.y * question.y.y + p.z * question.y.z + question.y.w;
    precise double h = p.x * question.cut.x + p.y * question.cut.y + p.z * question.cut.z;
    place[i] = dvec2(x, y);
    height[i] = h;
  }
  dvec2 low = min(min(place[0], place[1]), min(place[2], place[3]));
  dvec2 high = max(max(place[0], place[1]), max(place[2], place[3]));
  int first_row = first_beyond(low.y, question.rows);
  int end_row = first_beyond(high.y, question.rows);
  int first_column = first_beyond(low.x - spare, question.columns);
  int end_column = first_beyond(high.x + spare, question.columns);
  if (first_row >= end_row || first_column >= end_column) return;
  double highest = max(max(height[0], height[1]), max(height[2], height[3]));
  if (piece.lone != 0 && highest <= coplanar) return;

  dvec2 a = place[1] - place[0];
  dvec2 b = place[2] - place[0];
  dvec2 c = place[3] - place[0];
  precise double twice_area = (a.x * b.y - a.y * b.x) + (b.x * c.y - b.y * c.x);
  if (twice_area == 0.0lf) return;
  bool anticlockwise = twice_area > 0.0lf;
  float start[5];
  float slope[5];
  int side[5];
  int in_front = 0;
  dvec2 leaves = dvec2(0.0lf);
  dvec2 enters = dvec2(0.0lf);
  for (int i = 0; i < 4; ++i) {
    int next = (i + 1) % 4;
    find_edge(place[i], place[next], anticlockwise, start[i], slope[i], side[i]);
    precise double here = height[i] + question.cut.w;
    precise double there = height[next] + question.cut.w;
    if (here > 0.0lf) ++in_front;
    if ((here > 0.0lf) == (there > 0.0lf)) continue;
    precise double share = here / (here - there);
    precise dvec2 cut = place[i] + share * (place[next] - place[i]);
    if (here > 0.0lf) {
      leaves = cut;
    } else {
      enters = cut;
    }
  }
  if (in_front == 0) return;
  start[4] = 0.0;
  slope[4] = 0.0;
  side[4] = 0;
  if (in_front < 4) {
    if (leaves == enters) return;
    find_edge(leaves, enters, anticlockwise, start[4], slope[4], side[4]);
  }

  int first_word = first_column / 32;
  int words = (end_column - 1) / 32 - first_word + 1;
  int all = (end_row - first_row) * words;
  int at_once = 32 * int(gl_NumWorkGroups.z);
  for (int i = int(gl_LocalInvocationID.x + 32 * gl_WorkGroupID.z); i < all; i += at_once) {
    int row = first_row + i / words;
    int word = first_word + i % words;
    float from = 0.0;
    float to = float(question.columns);
    for (int k = 0; k < 5; ++k) {
      precise float limit = start[k] + float(row) * slope[k];
      if (side[k] > 0) to = min(to, limit);
      if (side[k] < 0) from = max(from, limit);
    }
    int first = max(int(min(from, float(question.columns)) + 0.5) - 32 * word, 0);
    int end = min(int(max(to, 0.0) + 0.5) - 32 * word, 32);
    if (first >= end) continue;
    uint bits = (0xFFFFFFFFu >> uint(32 - (end - first))) << uint(first);
    uint index = question.first_word + uint(row * question.stride + word);
    if (lights != 0) {
      atomicOr(masks[index], bits);
    } else if ((masks[index] & bits) != 0) {
      atomicAnd(masks[index], ~bits);
    }
  }
}

void main() {
  Question question = questions[gl_WorkGroupID.y];
  uint at_once = gl_NumWorkGroups.x * 4;
  for (uint i = gl_WorkGroupID.x * 4 + gl_LocalInvocationID.y; i < question.pieces; i += at_once) {
    Piece piece = pieces[question.first_piece + i];
    if (lights == 0) {
      uint word = counted[question.first_counted + piece.caster / 32];
      if ((word >> (piece.caster % 32) & 1u) == 0) continue;
    }
    cover(question, piece);
  }
}
