// The air before and between a fold and its mirror image at y = 0, up to the fold's end. Included after `Call Fold` drew
// the fold above y = 0 at fold_x = 0.
// Leaves: curves lungs, l_subglottal (wall, from the fold to the lungs), midline() from the lungs to point p_glottis_end.
DefineConstant[
  subglottal_length = 0.02,     // [m]
  h_subglottal = 0.0006         // [m] at the lungs
];
d0 = newp; Point(d0) = {-subglottal_length, 0, 0, h_subglottal};
d1 = newp; Point(d1) = {-subglottal_length, fold_base_y, 0, h_subglottal};
lungs = newl; Line(lungs) = {d1, d0};
l_subglottal = newl; Line(l_subglottal) = {fold_start, d1};

// The midline has points below each corner of the fold, of its cell size.
midline_h() = {h_subglottal, 2 * h_glottis, h_glottis, h_glottis, 1.6 * h_glottis};
midline_x() = {0, fold_corners_x(1), fold_corners_x(2), fold_corners_x(3), fold_end_x};
midline() = {};
previous = d0;
For i In {0 : 4}
  p = newp; Point(p) = {midline_x(i), 0, 0, midline_h(i)};
  l = newl; Line(l) = {previous, p};
  midline(i) = l;
  previous = p;
EndFor
p_glottis_end = previous;
