// A straight circular tube, a piston at x = 0; at x = length either open into nothing ("end") or, with baffled = 1, into a
// half ball of air behind an infinite baffle. Turned about the x axis in quarter turns, as cases/vowel_i/tract.geo. [m]
DefineConstant[
  length = 0.17,
  radius = 0.01,
  baffled = 0,              // 1: room instead of end
  quarters = 4,             // 1, 2 or 4; below 4 the rigid planes "symmetry" bound the rest
  h_tube = 0.004,           // [m] cell size in the tube
  room_radius = 0.06,       // [m]
  h_room = 0.006,           // [m]
  size_factor = 1           // multiplies every cell size
];

p0 = newp; Point(p0) = {0, 0, 0, h_tube};
p1 = newp; Point(p1) = {length, 0, 0, h_tube};
p2 = newp; Point(p2) = {length, radius, 0, h_tube};
p3 = newp; Point(p3) = {0, radius, 0, h_tube};
l_axis = newl; Line(l_axis) = {p0, p1};
l_end = newl;  Line(l_end) = {p1, p2};
l_wall = newl; Line(l_wall) = {p2, p3};
l_piston = newl; Line(l_piston) = {p3, p0};
loop = newll; Curve Loop(loop) = {l_axis, l_end, l_wall, l_piston};
s_tube = news; Plane Surface(s_tube) = {loop};
planes() = {s_tube};
If (baffled)
  p4 = newp; Point(p4) = {length + room_radius, 0, 0, h_room};
  p5 = newp; Point(p5) = {length, room_radius, 0, h_room};
  l_far = newl;    Line(l_far) = {p1, p4};
  l_open = newl;   Circle(l_open) = {p4, p1, p5};
  l_baffle = newl; Line(l_baffle) = {p5, p2};
  loop = newll; Curve Loop(loop) = {l_far, l_open, l_baffle, -l_end};
  s_room = news; Plane Surface(s_room) = {loop};
  planes() += s_room;
EndIf

// Extrude answers: end surface, volume, then one surface for each curve that is not on the axis, in order.
v_tube() = {}; v_room() = {};
g_end() = {}; g_walls() = {}; g_piston() = {}; g_open() = {}; g_baffle() = {};
For q In {1 : quarters}
  out() = Extrude { {1, 0, 0}, {0, 0, 0}, Pi / 2 } { Surface{s_tube}; };
  s_tube = out(0);
  v_tube() += out(1);
  g_end() += out(2);
  g_walls() += out(3);
  g_piston() += out(4);
  If (baffled)
    out() = Extrude { {1, 0, 0}, {0, 0, 0}, Pi / 2 } { Surface{s_room}; };
    s_room = out(0);
    v_room() += out(1);
    g_open() += out(2);
    g_baffle() += out(3);
  EndIf
EndFor

Physical Volume("tube") = {v_tube()};
Physical Surface("piston") = {g_piston()};
Physical Surface("walls") = {g_walls()};
Physical Surface("end") = {g_end()};
If (baffled)
  Physical Volume("room") = {v_room()};
  Physical Surface("open") = {g_open()};
  Physical Surface("baffle") = {g_baffle()};
EndIf
If (quarters < 4)
  Physical Surface("symmetry") = {planes(), s_tube};
  If (baffled)
    Physical Surface("symmetry") += {s_room};
  EndIf
EndIf

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Optimize = 1;
