// An elastic disc, with or without a core, above a wall in a bath, right half; x = 0 is the mirror. [m]
//
//    top _______________
//        |              |
//        |__  disc      |
//   axis |  \           | side
//        |__/           |
//        |   gap        |
//        |______________|
//              wall
DefineConstant[
  size = 1,                 // factor of all cell sizes
  radius = 0.01,            // [m]
  gap = 0.005,              // [m] between disc and wall at the start
  width = 0.03,             // [m] of the half bath
  height = 0.05,            // [m]
  h_contact = 0.0008,       // [m] at the lowest point of the disc, and on the wall below it
  h_disc = 0.002,           // [m] elsewhere on the disc
  h_bath = 0.004,           // [m] at the bath's far corners
  contact_width = 0.004,    // [m] of the disc and the wall, from the axis, where h_contact holds
  core = 0,                 // radius of a core of another material over the disc's; 0: none
  h_core = 0.0015           // [m] at the lowest point of the core
];

middle = gap + radius;
angle = Asin(contact_width / radius);
p_centre = newp;  Point(p_centre) = {0, middle, 0, size * h_disc};
p_low = newp;     Point(p_low) = {0, gap, 0, size * h_contact};
p_edge = newp;    Point(p_edge) = {radius * Sin(angle), middle - radius * Cos(angle), 0, size * h_contact};
p_side = newp;    Point(p_side) = {radius, middle, 0, size * h_disc};
p_high = newp;    Point(p_high) = {0, middle + radius, 0, size * h_disc};
p_foot = newp;    Point(p_foot) = {0, 0, 0, size * h_contact};
p_end = newp;     Point(p_end) = {contact_width, 0, 0, size * h_contact};
p_right = newp;   Point(p_right) = {width, 0, 0, size * h_bath};
p_corner = newp;  Point(p_corner) = {width, height, 0, size * h_bath};
p_top = newp;     Point(p_top) = {0, height, 0, size * h_bath};

c_contact = newl; Circle(c_contact) = {p_low, p_centre, p_edge};
c_low = newl;     Circle(c_low) = {p_edge, p_centre, p_side};
c_high = newl;    Circle(c_high) = {p_side, p_centre, p_high};
If (core > 0)
  p_core_low = newp;  Point(p_core_low) = {0, middle - core * radius, 0, size * h_core};
  p_core_side = newp; Point(p_core_side) = {core * radius, middle, 0, size * h_disc};
  p_core_high = newp; Point(p_core_high) = {0, middle + core * radius, 0, size * h_disc};
  c_core_low = newl;  Circle(c_core_low) = {p_core_low, p_centre, p_core_side};
  c_core_high = newl; Circle(c_core_high) = {p_core_side, p_centre, p_core_high};
  l_core_low = newl;  Line(l_core_low) = {p_centre, p_core_low};
  l_core_high = newl; Line(l_core_high) = {p_core_high, p_centre};
  l_lower = newl;     Line(l_lower) = {p_core_low, p_low};
  l_upper = newl;     Line(l_upper) = {p_high, p_core_high};
  core_axis() = {l_core_low, l_core_high};
  core_edge() = {-c_core_high, -c_core_low};
Else
  l_lower = newl;   Line(l_lower) = {p_centre, p_low};
  l_upper = newl;   Line(l_upper) = {p_high, p_centre};
  core_axis() = {};
  core_edge() = {};
EndIf
l_gap = newl;     Line(l_gap) = {p_low, p_foot};
l_foot = newl;    Line(l_foot) = {p_foot, p_end};
l_floor = newl;   Line(l_floor) = {p_end, p_right};
l_side = newl;    Line(l_side) = {p_right, p_corner};
l_top = newl;     Line(l_top) = {p_corner, p_top};
l_above = newl;   Line(l_above) = {p_top, p_high};

loop = newll;     Curve Loop(loop) = {c_contact, c_low, c_high, l_upper, core_edge(), l_lower};
s_disc = news;    Plane Surface(s_disc) = {loop};
If (core > 0)
  loop = newll;     Curve Loop(loop) = {l_core_low, c_core_low, c_core_high, l_core_high};
  s_core = news;    Plane Surface(s_core) = {loop};
  Physical Surface("core") = {s_core};
EndIf
loop = newll;     Curve Loop(loop) = {l_gap, l_foot, l_floor, l_side, l_top, l_above, -c_high, -c_low, -c_contact};
s_bath = news;    Plane Surface(s_bath) = {loop};

Physical Surface("fluid") = {s_bath};
Physical Surface("disc") = {s_disc};
Physical Curve("axis") = {l_lower, l_upper, core_axis(), l_gap, l_above};
Physical Curve("wall") = {l_foot, l_floor};
Physical Curve("side") = {l_side};
Physical Curve("top") = {l_top};
Physical Curve("surface") = {c_contact, c_low, c_high};

Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
