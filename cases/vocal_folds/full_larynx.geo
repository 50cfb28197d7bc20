// Plane larynx with two folds between rigid ducts. [m]
//
//    wall ______          _______________ wall
//               \  left  |
//   lungs                                 outlet      y = 0 between them
//               / right  |
//    wall ______/        |_______________ wall
//                 0      fold's end
//
// The left fold is above y = 0. Each has a gap, a size and regions of its own, cover_left, ligament_left, body_left and
// so on, and the right one may be displaced along x. Fold: fold.geo; duct: rigid_duct.geo.
Include "fold.geo";
Include "rigid_duct.geo";

DefineConstant[
  left_gap = 0.0005,            // [m] rest distance of the medial face from y = 0
  right_gap = 0.0005,           // [m]
  left_scale = 1,               // size of the fold relative to M5
  right_scale = 1,
  right_offset = 0,             // [m] along x, from the left fold's place
  subglottal_length = 0.02,     // [m] before the left fold
  h_subglottal = 0.0006         // [m] at the lungs
];

fold_x = 0;
side = 1;
gap = left_gap;
scale = left_scale;
Call Fold;
Call Duct;
left_end_x = fold_end_x;
left_outlet = p_outlet;
left_walls() = behind();
left_lungs = newp; Point(left_lungs) = {-subglottal_length, fold_base_y, 0, h_subglottal};
left_before = newl; Line(left_before) = {fold_start, left_lungs};
left_surface() = fold_surface();
left_base() = fold_base();
left_medial() = fold_medial();
left_layers() = fold_layers();

fold_x = right_offset;
side = -1;
gap = right_gap;
scale = right_scale;
Call Fold;
supraglottal_length += left_end_x - fold_end_x;  // both walls end at the same x
Call Duct;
p_lungs = newp; Point(p_lungs) = {-subglottal_length, fold_base_y, 0, h_subglottal};
before = newl; Line(before) = {p_lungs, fold_start};
lungs = newl; Line(lungs) = {left_lungs, p_lungs};
outlet = newl; Line(outlet) = {p_outlet, left_outlet};
loop = newll;
Curve Loop(loop) = {lungs, before, fold_surface(), behind(), outlet, -left_walls(), -left_surface(), left_before};
s_flow = news; Plane Surface(s_flow) = {loop};

Physical Surface("flow") = {s_flow};
If (cover_thickness > 0)
  Physical Surface("cover_left") = {left_layers(0)};
  Physical Surface("cover_right") = {s_cover};
EndIf
If (ligament_thickness > 0)
  Physical Surface("ligament_left") = {left_layers(layers - 1)};
  Physical Surface("ligament_right") = {s_ligament};
EndIf
Physical Surface("body_left") = {left_layers(layers)};
Physical Surface("body_right") = {s_body};
Physical Curve("lungs") = {lungs};
Physical Curve("walls") = {left_before, left_walls(), before, behind()};
Physical Curve("outlet") = {outlet};
Physical Curve("fold_base") = {left_base(), fold_base()};
Physical Curve("left_surface") = {left_surface()};
Physical Curve("right_surface") = {fold_surface()};

medial() = {left_medial(), fold_medial()};
jet_x = fold_end_x > left_end_x ? fold_end_x : left_end_x;
Include "cell_sizes.geo";
