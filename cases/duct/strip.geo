// A plane duct, a piston at x = 0; at x = length either open into nothing ("end") or, with baffled = 1, into a quarter disc
// of air behind an infinite baffle (y = 0 is then the symmetry line of the duct and of the room). [m]
DefineConstant[
  length = 0.17,
  height = 0.01,            // [m] of the half duct when baffled
  baffled = 0,              // 1: room instead of end
  h_strip = 0.0025,         // [m] cell size in the duct
  room_radius = 0.08,       // [m]
  h_room = 0.005,           // [m]
  size_factor = 1           // multiplies every cell size
];

p0 = newp; Point(p0) = {0, 0, 0, h_strip};
p1 = newp; Point(p1) = {length, 0, 0, h_strip};
p2 = newp; Point(p2) = {length, height, 0, h_strip};
p3 = newp; Point(p3) = {0, height, 0, h_strip};
l_bottom = newl; Line(l_bottom) = {p0, p1};
l_end = newl;    Line(l_end) = {p1, p2};
l_top = newl;    Line(l_top) = {p2, p3};
l_piston = newl; Line(l_piston) = {p3, p0};
loop = newll; Curve Loop(loop) = {l_bottom, l_end, l_top, l_piston};
s_duct = news; Plane Surface(s_duct) = {loop};

Physical Surface("duct") = {s_duct};
Physical Curve("piston") = {l_piston};
Physical Curve("walls") = {l_bottom, l_top};
Physical Curve("end") = {l_end};

If (baffled)
  p4 = newp; Point(p4) = {length + room_radius, 0, 0, h_room};
  p5 = newp; Point(p5) = {length, room_radius, 0, h_room};
  l_far = newl;    Line(l_far) = {p1, p4};
  l_open = newl;   Circle(l_open) = {p4, p1, p5};
  l_baffle = newl; Line(l_baffle) = {p5, p2};
  loop = newll; Curve Loop(loop) = {l_far, l_open, l_baffle, -l_end};
  s_room = news; Plane Surface(s_room) = {loop};
  Physical Surface("room") = {s_room};
  Physical Curve("symmetry") = {l_far};
  Physical Curve("open") = {l_open};
  Physical Curve("baffle") = {l_baffle};
EndIf

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
