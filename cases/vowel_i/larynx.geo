// Plane half model of a larynx with the vocal tract of /i/ and the room before the mouth. [m]
//
//    wall ______                 ___ ventricle              ____ tract (area_function.geo)      | baffle
//               \  fold (body,  |   \                 _____/    \______                   |
//   lungs        \  cover)      |    \_______________/                 \____          ____| mouth   room
//    y = 0 - - - -\_____________|- - - - - - - - - - - - - - - - - - - - - -\________/- - - - - - - -
//                 0          fold's end
//
// The fold is clamped at its lateral base, y = half_gap + 5 mm times its scale; ../vocal_folds/fold.geo draws it.
// The area function begins at the fold's superior face. A wedge-shaped ventricle stands in its first half section: its
// roof leaves the wall `ventricle_base` behind the fold's base, where the fold does not move, and meets the tract
// `ventricle_length` behind the superior face, where the fold moves most; so the moving fold has about 1 to 2 mm of air
// before any rigid wall, and cells there are not crushed.
Include "../vocal_folds/fold.geo";

DefineConstant[
  half_gap = 0.00025,           // [m] rest distance of the medial face from y = 0
  fold_scale = 1,               // size of the fold relative to M5
  ventricle_length = 0.002,     // [m]
  ventricle_base = 0.0006       // [m]
];

fold_x = 0;
side = 1;
gap = half_gap;
scale = fold_scale;
Call Fold;
Include "../vocal_folds/half_glottis.geo";

tract_start = fold_end_x;
tract_wall_start = fold_end_x + ventricle_length;
Include "planar_tract.geo";
p_ventricle = newp; Point(p_ventricle) = {fold_end_x + ventricle_base, fold_base_y, 0, h_fold};
l_ventricle = newl; Line(l_ventricle) = {p_ventricle, fold_end};
l_roof = newl; Line(l_roof) = {p_tract_top, p_ventricle};
l_behind = newl; Line(l_behind) = {p_glottis_end, p_tract_bottom};

loop = newll;
Curve Loop(loop) = {midline(), l_behind, flow_midline(), l_outlet, -flow_wall(), l_roof, l_ventricle,
                    -fold_surface(), l_subglottal, lungs};
s_flow = news; Plane Surface(s_flow) = {loop};

Physical Surface("flow") = {s_flow};
If (cover_thickness > 0)
  Physical Surface("cover") = {s_cover};
EndIf
If (ligament_thickness > 0)
  Physical Surface("ligament") = {s_ligament};
EndIf
Physical Surface("body") = {s_body};
Physical Surface("air") = {air()};
Physical Curve("lungs") = {lungs};
Physical Curve("walls") = {l_subglottal, l_ventricle, l_roof, tract_wall()};
Physical Curve("midline") = {midline(), l_behind, tract_midline(), room_midline};
Physical Curve("outlet") = {l_outlet};
Physical Curve("mouth") = {l_mouth};
Physical Curve("baffle") = {room_baffle};
Physical Curve("open") = {room_arc};
Physical Curve("fold_base") = {fold_base()};
Physical Curve("fold_surface") = {fold_surface()};

medial() = fold_medial();
jet_x = fold_end_x;
Include "../vocal_folds/cell_sizes.geo";
