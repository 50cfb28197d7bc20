// Two elastic plates face to face, with air between and beside them. [m]
//
//        ______ ______________ ______
//       |      |   upper      |      |  drive: the upper plate's back
//  side |  air  \____________/       | side
//       |       /------------\       |
//       |______|____lower_____|______|  base: the lower plate's back
//
// The faces are arcs, nearest to each other in the middle, so that the air is pressed out towards the sides.
DefineConstant[
  size = 1,                 // factor of all cell sizes
  half_width = 0.004,       // [m] of the plates
  thickness = 0.004,        // [m] of a plate in its middle
  gap = 0.0006,             // [m] between the plates' middles at the start
  crown = 0.0004,           // [m] by which the rim of a face lies behind its middle: contact does not reach it
  side = 0.004,             // [m] of air beside the plates
  h_gap = 0.0002,           // [m] on the faces
  h_back = 0.0008           // [m] on the plates' backs and beside them
];

face_radius = (half_width^2 + crown^2) / (2 * crown);
total = 2 * thickness + gap;
backs() = {};
rims() = {};
faces() = {};
For i In {0 : 1}
  // The lower plate, then its mirror image.
  s = i == 0 ? 1 : -1;
  y_back = i == 0 ? 0 : total;
  y_face = y_back + s * thickness;
  p1 = newp; Point(p1) = {-half_width, y_back, 0, size * h_back};
  p2 = newp; Point(p2) = {half_width, y_back, 0, size * h_back};
  p3 = newp; Point(p3) = {half_width, y_face - s * crown, 0, size * h_gap};
  p4 = newp; Point(p4) = {0, y_face, 0, size * h_gap};
  p5 = newp; Point(p5) = {-half_width, y_face - s * crown, 0, size * h_gap};
  p6 = newp; Point(p6) = {0, y_face - s * face_radius, 0, size * h_gap};
  p7 = newp; Point(p7) = {-half_width - side, y_back, 0, size * h_back};
  p8 = newp; Point(p8) = {half_width + side, y_back, 0, size * h_back};
  back = newl;  Line(back) = {p1, p2};
  right = newl; Line(right) = {p2, p3};
  face1 = newl; Circle(face1) = {p3, p6, p4};
  face2 = newl; Circle(face2) = {p4, p6, p5};
  left = newl;  Line(left) = {p5, p1};
  rim1 = newl;  Line(rim1) = {p7, p1};
  rim2 = newl;  Line(rim2) = {p2, p8};
  loop = newll; Curve Loop(loop) = {back, right, face1, face2, left};
  plates(i) = news; Plane Surface(plates(i)) = {loop};
  backs(i) = back;
  rims(2 * i) = rim1; rims(2 * i + 1) = rim2;
  faces(2 * i) = face1; faces(2 * i + 1) = face2;
  lefts(i) = left; rights(i) = right;
  ends_left(i) = p7; ends_right(i) = p8;
EndFor
l_left = newl;  Line(l_left) = {ends_left(1), ends_left(0)};
l_right = newl; Line(l_right) = {ends_right(0), ends_right(1)};
loop = newll;
Curve Loop(loop) = {rims(0), -lefts(0), -faces(1), -faces(0), -rights(0), rims(1), l_right,
                    -rims(3), rights(1), faces(2), faces(3), lefts(1), -rims(2), l_left};
s_air = news; Plane Surface(s_air) = {loop};

Physical Surface("air") = {s_air};
Physical Surface("lower") = {plates(0)};
Physical Surface("upper") = {plates(1)};
Physical Curve("base") = {backs(0)};
Physical Curve("drive") = {backs(1)};
Physical Curve("floor") = {rims(0), rims(1)};
Physical Curve("ceiling") = {rims(2), rims(3)};
Physical Curve("sides") = {l_left, l_right};
Physical Curve("lower_face") = {faces(0), faces(1)};
Physical Curve("upper_face") = {faces(2), faces(3)};

Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
