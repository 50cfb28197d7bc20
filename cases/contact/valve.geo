// Two elastic leaflets in a channel, leaning with the flow: what flows back closes them. [m]
//
//   _______________________________________________________
//  |        \\                                              |
//  |         \\)   upper                                    |
//  |                                                        |
//  |         //)   lower                                    |
//  |________//______________________________________________|
//  0        root                                         length
DefineConstant[
  size = 1,                 // factor of all cell sizes
  length = 8,               // [m] of the channel
  height = 1.61,            // [m]
  root = 2,                 // [m] where the leaflets begin
  leaflet = 1.0,            // [m] their length, the round tip left out
  thickness = 0.05,         // [m]
  angle = 0.7,              // [rad] between leaflets and walls
  h_tip = 0.03,             // [m] at the tips
  h_leaflet = 0.06,         // [m] at the roots
  h_channel = 0.2           // [m] at the ends
];

ca = Cos(angle); sa = Sin(angle);
foot = thickness / sa;
For i In {0 : 1}
  // The lower leaflet, then its mirror image.
  s = i == 0 ? 1 : -1;
  y0 = i == 0 ? 0 : height;
  tip_x = root + leaflet * ca;
  tip_y = leaflet * sa;
  q1 = newp; Point(q1) = {root, y0, 0, size * h_leaflet};
  q2 = newp; Point(q2) = {root + foot, y0, 0, size * h_leaflet};
  q3 = newp; Point(q3) = {tip_x + thickness * sa, y0 + s * (tip_y - thickness * ca), 0, size * h_tip};
  q4 = newp; Point(q4) = {tip_x, y0 + s * tip_y, 0, size * h_tip};
  q5 = newp; Point(q5) = {tip_x + 0.5 * thickness * sa, y0 + s * (tip_y - 0.5 * thickness * ca), 0, size * h_tip};
  q6 = newp; Point(q6) = {tip_x + 0.5 * thickness * (sa + ca), y0 + s * (tip_y + 0.5 * thickness * (sa - ca)), 0,
                          size * h_tip};
  roots(i) = newl; Line(roots(i)) = {q1, q2};
  backs(i) = newl; Line(backs(i)) = {q2, q3};
  tips(2 * i) = newl; Circle(tips(2 * i)) = {q3, q5, q6};
  tips(2 * i + 1) = newl; Circle(tips(2 * i + 1)) = {q6, q5, q4};
  fronts(i) = newl; Line(fronts(i)) = {q4, q1};
  loop = newll; Curve Loop(loop) = {roots(i), backs(i), tips(2 * i), tips(2 * i + 1), fronts(i)};
  leaflets(i) = news; Plane Surface(leaflets(i)) = {loop};
  q7 = newp; Point(q7) = {0, y0, 0, size * h_channel};
  q8 = newp; Point(q8) = {length, y0, 0, size * h_channel};
  before(i) = newl; Line(before(i)) = {q7, q1};
  behind(i) = newl; Line(behind(i)) = {q2, q8};
  ends_in(i) = q7; ends_out(i) = q8;
EndFor
l_in = newl;  Line(l_in) = {ends_in(1), ends_in(0)};
l_out = newl; Line(l_out) = {ends_out(0), ends_out(1)};
loop = newll;
Curve Loop(loop) = {before(0), -fronts(0), -tips(1), -tips(0), -backs(0), behind(0), l_out,
                    -behind(1), backs(1), tips(2), tips(3), fronts(1), -before(1), l_in};
s_fluid = news; Plane Surface(s_fluid) = {loop};

Physical Surface("fluid") = {s_fluid};
Physical Surface("lower") = {leaflets(0)};
Physical Surface("upper") = {leaflets(1)};
Physical Curve("inlet") = {l_in};
Physical Curve("outlet") = {l_out};
Physical Curve("walls") = {before(0), before(1), behind(0), behind(1)};
Physical Curve("roots") = {roots(0), roots(1)};
Physical Curve("lower_surface") = {fronts(0), tips(0), tips(1), backs(0)};
Physical Curve("upper_surface") = {fronts(1), tips(2), tips(3), backs(1)};

// Fine between the tips and growing from there.
Field[1] = Distance;
Field[1].CurvesList = {tips()};
Field[1].NumPointsPerCurve = 20;
Field[2] = MathEval;
Field[2].F = Sprintf("%g * (%g + 0.2 * F1)", size, h_tip);
Field[3] = Distance;
Field[3].CurvesList = {fronts(), backs()};
Field[3].NumPointsPerCurve = 100;
Field[4] = MathEval;
Field[4].F = Sprintf("%g * (%g + 0.3 * F3)", size, h_leaflet);
Field[5] = Min;
Field[5].FieldsList = {2, 4};
Background Field = 5;

Mesh.MeshSizeMax = size * h_channel;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
