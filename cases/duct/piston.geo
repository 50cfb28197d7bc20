// A circular piston in an infinite baffle, and a half ball of air before it: a wedge of a few degrees about the x axis, one
// cell thick, with rigid planes "symmetry". Nothing depends on the angle, and all sections of the wedge shrink alike. [m]
DefineConstant[
  radius = 0.01,            // [m] of the piston
  room_radius = 0.05,       // [m]
  wedge = 10,               // [degrees]
  h_piston = 0.001,         // [m] cell size at the piston
  h_room = 0.001,           // [m] at the open end
  size_factor = 1           // multiplies every cell size
];

p0 = newp; Point(p0) = {0, 0, 0, h_piston};
p1 = newp; Point(p1) = {room_radius, 0, 0, h_room};
p2 = newp; Point(p2) = {0, room_radius, 0, h_room};
p3 = newp; Point(p3) = {0, radius, 0, h_piston};
l_axis = newl;   Line(l_axis) = {p0, p1};
l_open = newl;   Circle(l_open) = {p1, p0, p2};
l_baffle = newl; Line(l_baffle) = {p2, p3};
l_piston = newl; Line(l_piston) = {p3, p0};
loop = newll; Curve Loop(loop) = {l_axis, l_open, l_baffle, l_piston};
s = news; Plane Surface(s) = {loop};
// End surface, volume, then one surface for each curve that is not on the axis, in order.
out() = Extrude { {1, 0, 0}, {0, 0, 0}, wedge * Pi / 180 } { Surface{s}; Layers{1}; };

Physical Volume("room") = {out(1)};
Physical Surface("open") = {out(2)};
Physical Surface("baffle") = {out(3)};
Physical Surface("piston") = {out(4)};
Physical Surface("symmetry") = {s, out(0)};

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
