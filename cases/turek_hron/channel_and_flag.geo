// The channel of Turek and Hron 2006 with cylinder and flag. [m] Included by fluid.geo, flag.geo and fsi.geo, which say
// with `has_fluid` and `has_flag` what is meshed; the sizes of cells are the same in all.
//
//   0.41 ________________________________________________________________________________________
//        |                                                                                       |
//  inlet |     ( )====================A      A = (0.6, 0.2), B = (0.15, 0.2)                     | outlet
//        |_______________________________________________________________________________________|
//        0    0.2  0.25             0.6                                                         2.5
//
// The flag's left end is the arc of the cylinder ("clamp"). Cells grow from the cylinder, the flag and four points: at
// the flag's tip the stress of the flow has no bound, at the clamp that of the solid, so cells there are smallest.
DefineConstant[
  size = 1,                 // factor of all cell sizes: 1, 0.5, 0.25 are the levels of the studies
  h_cylinder = 0.008,       // [m] on the cylinder
  h_flag = 0.012,           // [m] on the flag
  h_tip = 0.0004,           // [m] at the two corners of the flag's tip
  h_clamp = 0.0008,         // [m] at the two ends of the clamp
  h_wake = 0.016,           // [m] at most beside the flag and behind it, as far as wake_end
  h_channel = 0.035,        // [m] at most above and below, as far as wake_end
  h_outlet = 0.12,          // [m] at the outlet
  wake_width = 0.16,        // [m]
  wake_end = 0.75,          // [m]
  growth = 0.5              // of the cell size by distance
];

radius = 0.05;
half_thickness = 0.01;
centre_x = 0.2; centre_y = 0.2;
root_x = centre_x + Sqrt(radius^2 - half_thickness^2);
tip_x = 0.6;

p_centre = newp;     Point(p_centre) = {centre_x, centre_y, 0};
p_root_low = newp;   Point(p_root_low) = {root_x, centre_y - half_thickness, 0};
p_root_high = newp;  Point(p_root_high) = {root_x, centre_y + half_thickness, 0};
p_tip_low = newp;    Point(p_tip_low) = {tip_x, centre_y - half_thickness, 0};
p_tip = newp;        Point(p_tip) = {tip_x, centre_y, 0};
p_tip_high = newp;   Point(p_tip_high) = {tip_x, centre_y + half_thickness, 0};
l_low = newl;        Line(l_low) = {p_root_low, p_tip_low};
l_tip_low = newl;    Line(l_tip_low) = {p_tip_low, p_tip};
l_tip_high = newl;   Line(l_tip_high) = {p_tip, p_tip_high};
l_high = newl;       Line(l_high) = {p_tip_high, p_root_high};

If (has_flag)
  c_clamp = newl;    Circle(c_clamp) = {p_root_low, p_centre, p_root_high};
  loop = newll;      Curve Loop(loop) = {l_low, l_tip_low, l_tip_high, l_high, -c_clamp};
  s_flag = news;     Plane Surface(s_flag) = {loop};
  Physical Surface("solid") = {s_flag};
  Physical Curve("clamp") = {c_clamp};
EndIf
Physical Curve("flag") = {l_low, l_tip_low, l_tip_high, l_high};

cylinder() = {};
If (has_fluid)
  p_top = newp;      Point(p_top) = {centre_x, centre_y + radius, 0};
  p_front = newp;    Point(p_front) = {centre_x - radius, centre_y, 0};
  p_bottom = newp;   Point(p_bottom) = {centre_x, centre_y - radius, 0};
  c = newl;          Circle(c) = {p_root_high, p_centre, p_top};    cylinder(0) = c;
  c = newl;          Circle(c) = {p_top, p_centre, p_front};        cylinder(1) = c;
  c = newl;          Circle(c) = {p_front, p_centre, p_bottom};     cylinder(2) = c;
  c = newl;          Circle(c) = {p_bottom, p_centre, p_root_low};  cylinder(3) = c;
  p0 = newp;         Point(p0) = {0, 0, 0};
  p1 = newp;         Point(p1) = {2.5, 0, 0};
  p2 = newp;         Point(p2) = {2.5, 0.41, 0};
  p3 = newp;         Point(p3) = {0, 0.41, 0};
  l_bottom = newl;   Line(l_bottom) = {p0, p1};
  l_outlet = newl;   Line(l_outlet) = {p1, p2};
  l_top = newl;      Line(l_top) = {p2, p3};
  l_inlet = newl;    Line(l_inlet) = {p3, p0};
  outer = newll;     Curve Loop(outer) = {l_bottom, l_outlet, l_top, l_inlet};
  hole = newll;      Curve Loop(hole) = {l_low, l_tip_low, l_tip_high, l_high, cylinder()};
  s_fluid = news;    Plane Surface(s_fluid) = {outer, hole};
  Physical Surface("fluid") = {s_fluid};
  Physical Curve("inlet") = {l_inlet};
  Physical Curve("outlet") = {l_outlet};
  Physical Curve("walls") = {l_bottom, l_top};
  Physical Curve("cylinder") = {cylinder()};
EndIf

// The smallest of: from the cylinder, from the flag, from its tip's corners, from the clamp's ends, along the channel.
Field[1] = Distance;
Field[1].CurvesList = {cylinder()};
Field[1].NumPointsPerCurve = 100;
Field[2] = Distance;
Field[2].CurvesList = {l_low, l_tip_low, l_tip_high, l_high};
Field[2].NumPointsPerCurve = 200;
Field[3] = Distance;
Field[3].PointsList = {p_tip_low, p_tip_high};
Field[4] = Distance;
Field[4].PointsList = {p_root_low, p_root_high};
Field[5] = MathEval;
Field[5].F = Sprintf("%g * (%g + %g * F1)", size, h_cylinder, growth);
Field[6] = MathEval;
Field[6].F = Sprintf("%g * (%g + %g * F2)", size, h_flag, growth);
Field[7] = MathEval;
Field[7].F = Sprintf("%g * (%g + %g * F3)", size, h_tip, growth);
Field[8] = MathEval;
Field[8].F = Sprintf("%g * (%g + %g * F4)", size, h_clamp, growth);
Field[9] = MathEval;
Field[9].F = Sprintf("%g * (%g + %g * (x - %g + Abs(x - %g)))", size, h_channel,
                     0.5 * (h_outlet - h_channel) / (2.5 - wake_end), wake_end, wake_end);
Field[10] = Box;
Field[10].XMin = centre_x;
Field[10].XMax = wake_end;
Field[10].YMin = centre_y - wake_width / 2;
Field[10].YMax = centre_y + wake_width / 2;
Field[10].VIn = size * h_wake;
Field[10].VOut = size * h_outlet;
Field[10].Thickness = (h_outlet - h_wake) / growth;
Field[11] = Min;
Field[11].FieldsList = {5, 6, 7, 8, 9, 10};
Background Field = 11;

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
