// The larynx of larynx.geo as a whole: two folds, each with a gap, a size and regions of its own (cover_left, cover_right,
// ...), the left one above y = 0, with tract and room on both sides of y = 0. [m]
Include "../vocal_folds/fold.geo";

DefineConstant[
  left_gap = 0.00025,           // [m] rest distance of the medial face from y = 0
  right_gap = 0.00025,          // [m]
  left_scale = 1,               // size of the fold relative to M5
  right_scale = 1,
  subglottal_length = 0.02,     // [m]
  ventricle_length = 0.002,     // [m] see larynx.geo
  ventricle_base = 0.0006,      // [m]
  h_subglottal = 0.0006         // [m] at the lungs
];

// The tract and the room above y = 0, then their mirror images.
tract_start = 0.0078070 * (left_scale > right_scale ? left_scale : right_scale);
tract_wall_start = tract_start + ventricle_length;
Include "planar_tract.geo";
l_entry = newl; Line(l_entry) = {p_tract_bottom, p_tract_top};
loop = newll; Curve Loop(loop) = {flow_midline(), l_outlet, -flow_wall(), -l_entry};
s_above = news; Plane Surface(s_above) = {loop};
below() = Symmetry {0, 1, 0, 0} { Duplicata { Surface{s_above, air()}; } };
b_flow() = Abs(Boundary{ Surface{below(0)}; });  // in the order of the loop
b_room() = Abs(Boundary{ Surface{below(1)}; });
outlet_below = b_flow(#flow_midline());
walls_below() = b_flow({#flow_midline() + 1 : #b_flow() - 2});
l_entry_below = b_flow(#b_flow() - 1);
If (#air() > 1)
  b_tract() = Abs(Boundary{ Surface{below(2)}; });
  walls_below() += b_tract({n - flow_end : #b_tract() - 2});
EndIf
entry_points() = PointsOf{ Curve{l_entry_below}; };  // its wall's point, then that of y = 0

fold_x = 0;
For fold In {0 : 1}
  side = 1 - 2 * fold;
  gap = fold == 0 ? left_gap : right_gap;
  scale = fold == 0 ? left_scale : right_scale;
  Call Fold;
  p_lungs = newp; Point(p_lungs) = {-subglottal_length, fold_base_y, 0, h_subglottal};
  p = newp; Point(p) = {fold_end_x + ventricle_base, fold_base_y, 0, h_fold};
  p_roof = side > 0 ? p_tract_top : entry_points(0);
  l_subglottal = newl; Line(l_subglottal) = {p_lungs, fold_start};
  l_ventricle = newl; Line(l_ventricle) = {fold_end, p};
  l_roof = newl; Line(l_roof) = {p, p_roof};
  If (side > 0)
    left_layers() = fold_layers();
    left_surface() = fold_surface();
    left_base() = fold_base();
    left_medial() = fold_medial();
    left_walls() = {l_subglottal, l_ventricle, l_roof};
    left_lungs = p_lungs;
  EndIf
EndFor
right_walls() = {l_subglottal, l_ventricle, l_roof};
lungs = newl; Line(lungs) = {left_lungs, p_lungs};
loop = newll;
Curve Loop(loop) = {lungs, l_subglottal, fold_surface(), l_ventricle, l_roof, l_entry_below, l_entry,
                    -left_walls(), -left_surface()};
s_larynx = news; Plane Surface(s_larynx) = {loop};

Physical Surface("flow") = {s_larynx, s_above, below(0)};
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
Physical Surface("air") = {air(), below({1 : #below() - 1})};
Physical Curve("lungs") = {lungs};
Physical Curve("walls") = {left_walls(), right_walls(), tract_wall(), walls_below()};
Physical Curve("outlet") = {l_outlet, outlet_below};
Physical Curve("mouth") = {l_mouth, b_room(3)};
Physical Curve("baffle") = {room_baffle, b_room(2)};
Physical Curve("open") = {room_arc, b_room(1)};
Physical Curve("fold_base") = {left_base(), fold_base()};
Physical Curve("left_surface") = {left_surface()};
Physical Curve("right_surface") = {fold_surface()};

medial() = {left_medial(), fold_medial()};
jet_x = tract_start;
Include "../vocal_folds/cell_sizes.geo";
