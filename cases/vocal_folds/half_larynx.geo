// Plane half model of a larynx between rigid ducts, y = 0 is the mirror. [m]
//
//    wall ______          _______________ wall
//               \  fold  |
//   lungs        \       |                outlet
//    y = 0 - - - -\______|- - - - - - - -
//                 0      fold's end
//
// Regions flow, cover, ligament and body (a layer without thickness is none). Fold: fold.geo; duct: rigid_duct.geo.
Include "fold.geo";
Include "rigid_duct.geo";

DefineConstant[
  half_gap = 0.0005,            // [m] rest distance of the medial face from y = 0
  fold_scale = 1                // size of the fold relative to M5
];

fold_x = 0;
side = 1;
gap = half_gap;
scale = fold_scale;
Call Fold;
Call Duct;
Include "half_glottis.geo";
p = newp; Point(p) = {outlet_x, 0, 0, h_outlet};
l_behind = newl; Line(l_behind) = {p_glottis_end, p};
outlet = newl; Line(outlet) = {p, p_outlet};
loop = newll; Curve Loop(loop) = {lungs, midline(), l_behind, outlet, -behind(), -fold_surface(), l_subglottal};
s_flow = news; Plane Surface(s_flow) = {loop};

Physical Surface("flow") = {s_flow};
If (cover_thickness > 0)
  Physical Surface("cover") = {s_cover};
EndIf
If (ligament_thickness > 0)
  Physical Surface("ligament") = {s_ligament};
EndIf
Physical Surface("body") = {s_body};
Physical Curve("lungs") = {lungs};
Physical Curve("walls") = {l_subglottal, behind()};
Physical Curve("midline") = {midline(), l_behind};
Physical Curve("outlet") = {outlet};
Physical Curve("fold_base") = {fold_base()};
Physical Curve("fold_surface") = {fold_surface()};

medial() = fold_medial();
jet_x = fold_end_x;
Include "cell_sizes.geo";
