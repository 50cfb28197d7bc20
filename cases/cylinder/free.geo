// A cylinder in a free stream, and the air around the flow. The plane, lengths in diameters D times `diameter` [m].
//
//   y                    _______________ air: square of half_air ________________
//                       |    _____________________________________________       |
//                       |   | sides                                       |      |
//                       |   |                                             |      |
//                       |   | inlet        ( ) cylinder, D = 1            | outlet
//                       |   |               0 within "permeable"          |      |
//                       |   |_____________________________________________|      |
//                       |_-half_flow___________________________________half_flow_|
DefineConstant[
  size = 1,                 // factor of all cell sizes of the flow
  diameter = 0.2,           // [m]
  half_flow = 50,           // [D] half width of the square that the flow fills
  with_air = 0,             // 1: the air around it, too
  half_air = 100,           // [D] half width of the square that the air ends at
  h_cylinder = 0.06,        // [D] on the cylinder
  growth = 0.2,             // of the cell size by distance from the cylinder
  h_wake = 0.4,             // [D] at most, as far as wake_end behind the cylinder
  wake_end = 10,            // [D]
  h_far = 5,                // [D] at most, in the flow
  h_air = 2,                // [D] at most, in the air: the flow's cells become no larger, either, if there is air
  permeable_radius = 2      // [D] of the circle "permeable"
];

d = diameter;

Function Circle_of_radius   // -> arcs[], around the origin
  q0 = newp; Point(q0) = {0, 0, 0};
  q1 = newp; Point(q1) = {radius, 0, 0};
  q2 = newp; Point(q2) = {0, radius, 0};
  q3 = newp; Point(q3) = {-radius, 0, 0};
  q4 = newp; Point(q4) = {0, -radius, 0};
  k1 = newl; Circle(k1) = {q1, q0, q2};
  k2 = newl; Circle(k2) = {q2, q0, q3};
  k3 = newl; Circle(k3) = {q3, q0, q4};
  k4 = newl; Circle(k4) = {q4, q0, q1};
  arcs[] = {k1, k2, k3, k4};
Return

Function Square_of_half_width   // -> edges[] from the lower side on, around the origin
  q1 = newp; Point(q1) = {-half, -half, 0};
  q2 = newp; Point(q2) = {half, -half, 0};
  q3 = newp; Point(q3) = {half, half, 0};
  q4 = newp; Point(q4) = {-half, half, 0};
  k1 = newl; Line(k1) = {q1, q2};
  k2 = newl; Line(k2) = {q2, q3};
  k3 = newl; Line(k3) = {q3, q4};
  k4 = newl; Line(k4) = {q4, q1};
  edges[] = {k1, k2, k3, k4};
Return

radius = 0.5 * d;
Call Circle_of_radius;
cylinder[] = arcs[];
radius = permeable_radius * d;
Call Circle_of_radius;
permeable[] = arcs[];
half = half_flow * d;
Call Square_of_half_width;
box[] = edges[];

l_cylinder = newll;  Curve Loop(l_cylinder) = {cylinder[]};
l_permeable = newll; Curve Loop(l_permeable) = {permeable[]};
l_box = newll;       Curve Loop(l_box) = {box[]};
s_near = news;       Plane Surface(s_near) = {l_permeable, l_cylinder};
s_flow = news;       Plane Surface(s_flow) = {l_box, l_permeable};

Physical Surface("fluid") = {s_near, s_flow};
Physical Curve("cylinder") = {cylinder[]};
Physical Curve("permeable") = {permeable[]};
Physical Curve("sides") = {box[0], box[2]};
Physical Curve("outlet") = {box[1]};
Physical Curve("inlet") = {box[3]};

If (with_air)
  half = half_air * d;
  Call Square_of_half_width;
  l_air = newll;        Curve Loop(l_air) = {edges[]};
  s_air = news;         Plane Surface(s_air) = {l_air, l_box};
  Physical Surface("air") = {s_air};
  Physical Curve("end_of_air") = {edges[]};
EndIf

// The smallest of: by the distance from the cylinder; in the wake; anywhere.
Field[1] = Distance;
Field[1].CurvesList = {cylinder[]};
Field[1].NumPointsPerCurve = 100;
Field[2] = MathEval;
Field[2].F = Sprintf("%g * (%g + %g * F1)", size, h_cylinder * d, growth);
// Behind the cylinder as far as wake_end, growing from there on and to the sides.
Field[3] = MathEval;
Field[3].F = Sprintf("%g * (%g + 0.05 * (x - %g + Abs(x - %g)) + 0.15 * (Abs(y) - %g + Abs(Abs(y) - %g)) + 0.5 * (Abs(x) - x))", size,
                     h_wake * d, wake_end * d, wake_end * d, 2 * d, 2 * d);
Field[4] = MathEval;
Field[4].F = Sprintf("%g", with_air ? h_air * d : size * h_far * d);
Field[5] = Min;
Field[5].FieldsList = {2, 3, 4};
Background Field = 5;

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
