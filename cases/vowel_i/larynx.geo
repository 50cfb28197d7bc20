// Plane half model of a larynx with the vocal tract of /i/ and the room before the mouth. [m]
//
//    wall ______                 ___ ventricle              ____ tract (area_function.geo)      | baffle
//               \  fold (body,  |   \                 _____/    \______                   |
//   lungs        \  cover)      |    \_______________/                 \____          ____| mouth   room
//    y = 0 - - - -\_____________|- - - - - - - - - - - - - - - - - - - - - -\________/- - - - - - - -
//                 0          fold length
//
// Fold: M5 of Scherer, Shinwari, De Witt, Zhang, Kucinschi and Afjeh 2001, J. Acoust. Soc. Am. 109, 1616, medial face
// inclined by 3 degrees: straight at 50 degrees from the wall, arc of 1.5 mm, medial straight, arc of 0.987 mm, superior
// straight. It is clamped at its lateral base, y = half_gap + 5 mm. The cover is a layer of constant thickness.
// The area function begins at the fold's superior face. A wedge-shaped ventricle stands in its first half section: its
// roof leaves the wall `ventricle_base` behind the fold's base, where the fold does not move, and meets the tract
// `ventricle_length` behind the superior face, where the fold moves most; so the moving fold has about 1 to 2 mm of air
// before any rigid wall, and cells there are not crushed.
DefineConstant[
  half_gap = 0.00025,           // [m] rest distance of the medial face from y = 0
  fold_scale = 1,               // size of the fold relative to M5
  cover_thickness = 0.0005,     // [m] below 0.9 mm
  subglottal_length = 0.02,     // [m]
  ventricle_length = 0.002,     // [m]
  ventricle_base = 0.0006,      // [m]
  h_glottis = 0.00008,          // [m] at the medial face and the superior arc
  h_fold = 0.00028,             // [m] at the fold's base and inside its body
  h_jet = 0.00022,              // [m] behind the glottis, over jet_length
  jet_length = 0.015,           // [m]
  h_subglottal = 0.0006,        // [m] at the lungs
  size_factor = 1               // multiplies every cell size
];

fold_height = 0.005 * fold_scale;
fold_length = 0.0078070 * fold_scale;
duct_height = half_gap + fold_height;
tract_start = fold_length;
tract_wall_start = fold_length + ventricle_length;
Include "planar_tract.geo";

// M5 drawing in cm: y = 0 at the base, 0.5 at the medial edge; two arcs (centre, radius) tangent to the straights.
ax = 0.48070; ay = 0.33951; ar = 0.15;
bx = 0.68200; by = 0.40144; br = 0.0987;
sine = Sin(50 * Pi / 180);
cosine = Cos(50 * Pi / 180);
inclination = 3 * Pi / 180;
h_mid = 0.5 * (h_glottis + h_fold);

fold_points() = {};
// The surface (layer 0) and the line between cover and body (layer 1): the same arcs with smaller radii.
p_a = newp; Point(p_a) = {0.01 * fold_scale * ax, duct_height - 0.01 * fold_scale * ay, 0, h_fold};
p_b = newp; Point(p_b) = {0.01 * fold_scale * bx, duct_height - 0.01 * fold_scale * by, 0, h_fold};
For layer In {0 : 1}
  inside = layer * 100 * cover_thickness / fold_scale;  // [cm] on the drawing
  cr = ar - inside;
  dr = br - inside;
  m5_x() = {inside / sine, ax - cr * sine, ax - cr * Sin(inclination), bx - dr * Sin(inclination), bx + dr, bx + dr};
  m5_y() = {0, ay + cr * cosine, ay + cr * Cos(inclination), by + dr * Cos(inclination), by, 0};
  If (layer == 0)
    h() = {h_fold, 1.6 * h_glottis, h_glottis, h_glottis, 1.6 * h_glottis, h_fold};
  Else
    h() = {h_fold, h_mid, h_mid, h_mid, h_mid, h_fold};
  EndIf
  For i In {0 : 5}
    p = newp;
    Point(p) = {0.01 * fold_scale * m5_x(i), duct_height - 0.01 * fold_scale * m5_y(i), 0, h(i)};
    fold_points(6 * layer + i) = p;
  EndFor
EndFor
s0 = fold_points(0); s1 = fold_points(1); s2 = fold_points(2);
s3 = fold_points(3); s4 = fold_points(4); s5 = fold_points(5);
c0 = fold_points(6); c1 = fold_points(7); c2 = fold_points(8);
c3 = fold_points(9); c4 = fold_points(10); c5 = fold_points(11);

f0 = newl; Line(f0) = {s0, s1};
f1 = newl; Circle(f1) = {s1, p_a, s2};
f2 = newl; Line(f2) = {s2, s3};
f3 = newl; Circle(f3) = {s3, p_b, s4};
f4 = newl; Line(f4) = {s4, s5};
g0 = newl; Line(g0) = {c0, c1};
g1 = newl; Circle(g1) = {c1, p_a, c2};
g2 = newl; Line(g2) = {c2, c3};
g3 = newl; Circle(g3) = {c3, p_b, c4};
g4 = newl; Line(g4) = {c4, c5};
b0 = newl; Line(b0) = {s0, c0};
b1 = newl; Line(b1) = {c0, c5};
b2 = newl; Line(b2) = {c5, s5};

loop = newll; Curve Loop(loop) = {f0, f1, f2, f3, f4, -b2, -g4, -g3, -g2, -g1, -g0, -b0};
s_cover = news; Plane Surface(s_cover) = {loop};
loop = newll; Curve Loop(loop) = {g0, g1, g2, g3, g4, -b1};
s_body = news; Plane Surface(s_body) = {loop};

// Air below and around the fold; the midline has points below each corner of the fold, of its cell size.
d0 = newp; Point(d0) = {-subglottal_length, 0, 0, h_subglottal};
d1 = newp; Point(d1) = {-subglottal_length, duct_height, 0, h_subglottal};
m0 = newp; Point(m0) = {0, 0, 0, h_subglottal};
m1 = newp; Point(m1) = {0.01 * fold_scale * (ax - ar * sine), 0, 0, 2 * h_glottis};
m2 = newp; Point(m2) = {0.01 * fold_scale * ax, 0, 0, h_glottis};
m3 = newp; Point(m3) = {0.01 * fold_scale * bx, 0, 0, h_glottis};
m4 = newp; Point(m4) = {fold_length, 0, 0, 1.6 * h_glottis};
v0 = newp; Point(v0) = {fold_length + ventricle_base, duct_height, 0, h_fold};
lungs = newl; Line(lungs) = {d1, d0};
n0 = newl; Line(n0) = {d0, m0};
n1 = newl; Line(n1) = {m0, m1};
n2 = newl; Line(n2) = {m1, m2};
n3 = newl; Line(n3) = {m2, m3};
n4 = newl; Line(n4) = {m3, m4};
n5 = newl; Line(n5) = {m4, p_tract_bottom};
w0 = newl; Line(w0) = {s0, d1};
w1 = newl; Line(w1) = {v0, s5};
w2 = newl; Line(w2) = {p_tract_top, v0};
loop = newll;
Curve Loop(loop) = {n0, n1, n2, n3, n4, n5, tract_midline(), l_mouth, -tract_wall(), w2, w1,
                    -f4, -f3, -f2, -f1, -f0, w0, lungs};
s_flow = news; Plane Surface(s_flow) = {loop};

Physical Surface("flow") = {s_flow};
Physical Surface("cover") = {s_cover};
Physical Surface("body") = {s_body};
Physical Surface("room") = {s_room};
Physical Curve("lungs") = {lungs};
Physical Curve("walls") = {w0, w1, w2, tract_wall()};
Physical Curve("midline") = {n0, n1, n2, n3, n4, n5, tract_midline(), room_midline};
Physical Curve("mouth") = {l_mouth};
Physical Curve("baffle") = {room_baffle};
Physical Curve("open") = {room_arc};
Physical Curve("fold_base") = {b0, b1, b2};
Physical Curve("fold_surface") = {f0, f1, f2, f3, f4};

// Finer near the glottis and in the jet; elsewhere the points' sizes rule.
Field[1] = Distance;
Field[1].CurvesList = {f1, f2, f3};
Field[1].NumPointsPerCurve = 60;
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = h_glottis;
Field[2].SizeMax = h_room;
Field[2].DistMin = 0.0003;
Field[2].DistMax = 0.03;
Field[3] = Box;
Field[3].XMin = fold_length;
Field[3].XMax = fold_length + jet_length;
Field[3].YMin = 0;
Field[3].YMax = 0.0016;
Field[3].VIn = h_jet;
Field[3].VOut = h_room;
Field[3].Thickness = 0.03;
Field[4] = Min;
Field[4].FieldsList = {2, 3};
Background Field = 4;

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
