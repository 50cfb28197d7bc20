// The channel with a cylinder of Schaefer and Turek 1996 in the plane. [m]
//
//   0.41 ________________________________________________________________________________________
//        |                                                                                       |
//  inlet |     ( )                           circle of diameter 0.1 around (0.2, 0.2)            | outlet
//        |_______________________________________________________________________________________|
//        0     0.2                                                                              2.2
DefineConstant[
  size = 1,                 // factor of all cell sizes: 1, 0.5, 0.25 are the levels of the studies
  length = 2.2,             // [m]
  h_cylinder = 0.009,       // [m] on the cylinder
  h_channel = 0.03,         // [m] at most, as far as wake_end
  h_outlet = 0.08,          // [m] at x = 2.2 m
  wake_end = 0.6,           // [m]
  growth = 0.25             // of the cell size by distance from the cylinder
];

radius = 0.05;
centre_x = 0.2; centre_y = 0.2;

// Front (0.15, 0.2) and back (0.25, 0.2), where the pressure is read, are vertices.
p_centre = newp;  Point(p_centre) = {centre_x, centre_y, 0};
p_back = newp;    Point(p_back) = {centre_x + radius, centre_y, 0};
p_top = newp;     Point(p_top) = {centre_x, centre_y + radius, 0};
p_front = newp;   Point(p_front) = {centre_x - radius, centre_y, 0};
p_bottom = newp;  Point(p_bottom) = {centre_x, centre_y - radius, 0};
c0 = newl;        Circle(c0) = {p_back, p_centre, p_top};
c1 = newl;        Circle(c1) = {p_top, p_centre, p_front};
c2 = newl;        Circle(c2) = {p_front, p_centre, p_bottom};
c3 = newl;        Circle(c3) = {p_bottom, p_centre, p_back};
p0 = newp;        Point(p0) = {0, 0, 0};
p1 = newp;        Point(p1) = {length, 0, 0};
p2 = newp;        Point(p2) = {length, 0.41, 0};
p3 = newp;        Point(p3) = {0, 0.41, 0};
l_bottom = newl;  Line(l_bottom) = {p0, p1};
l_outlet = newl;  Line(l_outlet) = {p1, p2};
l_top = newl;     Line(l_top) = {p2, p3};
l_inlet = newl;   Line(l_inlet) = {p3, p0};
outer = newll;    Curve Loop(outer) = {l_bottom, l_outlet, l_top, l_inlet};
hole = newll;     Curve Loop(hole) = {c0, c1, c2, c3};
s_fluid = news;   Plane Surface(s_fluid) = {outer, hole};

Physical Surface("fluid") = {s_fluid};
Physical Curve("inlet") = {l_inlet};
Physical Curve("outlet") = {l_outlet};
Physical Curve("walls") = {l_bottom, l_top};
Physical Curve("cylinder") = {c0, c1, c2, c3};

// The smaller of: by the distance from the cylinder, along the channel.
Field[1] = Distance;
Field[1].CurvesList = {c0, c1, c2, c3};
Field[1].NumPointsPerCurve = 100;
Field[2] = MathEval;
Field[2].F = Sprintf("%g * (%g + %g * F1)", size, h_cylinder, growth);
Field[3] = MathEval;
Field[3].F = Sprintf("%g * (%g + %g * (x - %g + Abs(x - %g)))", size, h_channel,
                     0.5 * (h_outlet - h_channel) / (2.2 - wake_end), wake_end, wake_end);
Field[4] = Min;
Field[4].FieldsList = {2, 3};
Background Field = 4;

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
