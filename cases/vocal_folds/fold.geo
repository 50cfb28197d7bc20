// One elastic vocal fold in the plane, of up to three layers; `Call Fold` draws it. Included by the larynxes of this folder
// and of cases/vowel_i. [m]
//
//      base, clamped      y = side (gap + height)      u: along x, from fold_x
//    ----+---------+----                               v: from the base towards y = 0
//         \ body  |       cover outside, then ligament, each of constant thickness
//          \______|       y = side * gap
//
// Shapes: 0 is M5 of Scherer, Shinwari, De Witt, Zhang, Kucinschi and Afjeh 2001, J. Acoust. Soc. Am. 109, 1616, medial face
// inclined by 3 degrees: straight at 50 degrees from the wall, arc of 1.5 mm, medial straight, arc of 0.987 mm, superior
// straight. 1 is half an ellipse as long and as high as M5; its layers are ellipses with semi-axes shorter by their depth.
DefineConstant[
  shape = 0,                    // 0: M5, 1: half an ellipse
  cover_thickness = 0.0005,     // [m] 0: no cover. Of M5, all layers outside the body together below 0.9 mm times the scale
  ligament_thickness = 0,       // [m] 0: no ligament
  h_glottis = 0.00008,          // [m] at the medial face and the superior arc
  h_fold = 0.00028              // [m] at the fold's base and inside its body
];

// Before each call: fold_x (where the fold begins), side (1: above y = 0, -1: below), gap [m] and scale (1: as large as M5)
// of this fold. Leaves fold_end_x, fold_base_y, fold_corners_x() of the surface; points fold_start, fold_end; curves
// fold_surface() from start to end, fold_medial() among them, fold_base(); surfaces s_cover, s_ligament, if any, s_body.
Macro Fold
  unit = 0.01 * scale;  // the drawing is in cm
  fold_end_x = fold_x + 0.78070 * unit;
  fold_base_y = side * (gap + 0.5 * unit);
  ax = 0.48070; ay = 0.33951; ar = 0.15;  // centres and radii of the arcs of M5
  bx = 0.68200; by = 0.40144; br = 0.0987;
  sine = Sin(50 * Pi / 180);
  cosine = Cos(50 * Pi / 180);
  inclination = 3 * Pi / 180;
  h_mid = 0.5 * (h_glottis + h_fold);

  layers = 0;
  depths() = {0};
  If (cover_thickness > 0)
    layers += 1;
    depths(layers) = cover_thickness;
  EndIf
  If (ligament_thickness > 0)
    layers += 1;
    depths(layers) = cover_thickness + ligament_thickness;
  EndIf

  p_a = newp; Point(p_a) = {fold_x + unit * ax, fold_base_y - side * unit * ay, 0, h_fold};
  p_b = newp; Point(p_b) = {fold_x + unit * bx, fold_base_y - side * unit * by, 0, h_fold};
  p_c = newp; Point(p_c) = {0.5 * (fold_x + fold_end_x), fold_base_y, 0, h_fold};
  fold_points() = {};
  fold_curves() = {};
  For layer In {0 : layers}
    inside = depths(layer) / unit;
    If (shape == 0)
      cr = ar - inside;
      dr = br - inside;
      u() = {inside / sine, ax - cr * sine, ax - cr * Sin(inclination), bx - dr * Sin(inclination), bx + dr, bx + dr};
      v() = {0, ay + cr * cosine, ay + cr * Cos(inclination), by + dr * Cos(inclination), by, 0};
    Else
      // Not symmetric: Gmsh finds no ellipse through an arc's two ends if they mirror each other.
      angles() = {0, 0.19 * Pi, 0.38 * Pi, 0.6 * Pi, 0.8 * Pi, Pi};
      For i In {0 : 5}
        u(i) = 0.39035 - (0.39035 - inside) * Cos(angles(i));
        v(i) = (0.5 - inside) * Sin(angles(i));
      EndFor
    EndIf
    h() = {h_fold, h_mid, h_mid, h_mid, h_mid, h_fold};
    If (layer == 0)
      h() = {h_fold, 1.6 * h_glottis, h_glottis, h_glottis, 1.6 * h_glottis, h_fold};
      For i In {0 : 5}
        fold_corners_x(i) = fold_x + unit * u(i);
      EndFor
    EndIf
    For i In {0 : 5}
      p = newp; Point(p) = {fold_x + unit * u(i), fold_base_y - side * unit * v(i), 0, h(i)};
      fold_points(6 * layer + i) = p;
    EndFor
    For i In {0 : 4}
      l = newl;
      p = fold_points(6 * layer + i);
      q = fold_points(6 * layer + i + 1);
      If (shape == 1)
        Ellipse(l) = {p, p_c, fold_points(6 * layer), q};
      ElseIf (i == 1 || i == 3)
        centre = i == 1 ? p_a : p_b;
        Circle(l) = {p, centre, q};
      Else
        Line(l) = {p, q};
      EndIf
      fold_curves(5 * layer + i) = l;
    EndFor
  EndFor

  fold_base() = {};
  fold_layers() = {};
  For layer In {0 : layers}
    line() = fold_curves({5 * layer : 5 * layer + 4});
    If (layer < layers)
      inner() = fold_curves({5 * layer + 5 : 5 * layer + 9});
      l = newl; Line(l) = {fold_points(6 * layer), fold_points(6 * layer + 6)};
      r = newl; Line(r) = {fold_points(6 * layer + 11), fold_points(6 * layer + 5)};
      fold_base() += {l, r};
      loop = newll; Curve Loop(loop) = {line(), -r, -inner(4), -inner(3), -inner(2), -inner(1), -inner(0), -l};
    Else
      l = newl; Line(l) = {fold_points(6 * layer), fold_points(6 * layer + 5)};
      fold_base() += {l};
      loop = newll; Curve Loop(loop) = {line(), -l};
    EndIf
    s = news; Plane Surface(s) = {loop};
    fold_layers(layer) = s;
  EndFor
  s_body = fold_layers(layers);
  If (cover_thickness > 0)
    s_cover = fold_layers(0);
  EndIf
  If (ligament_thickness > 0)
    s_ligament = fold_layers(layers - 1);
  EndIf
  fold_start = fold_points(0);
  fold_end = fold_points(5);
  fold_surface() = fold_curves({0 : 4});
  fold_medial() = fold_curves({1 : 3});
  If (shape == 1)
    fold_medial() = fold_curves({2 : 2});
  EndIf
Return
