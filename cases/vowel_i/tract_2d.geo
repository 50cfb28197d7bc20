// The plane half tract of /i/ alone: closed glottis at x = 0, tract, room behind an infinite baffle. [m]
//
// For pulse runs with a volume velocity prescribed at "glottis": its resonances are those of the tract without the larynx.
// They are not those of larynx.geo, whose tract also feels the ventricle, the open glottis and the subglottal duct; for
// these drive larynx.geo itself through its group "fold_surface" (README.md).
DefineConstant[ size_factor = 1 ];  // multiplies every cell size
tract_start = 0;
tract_wall_start = 0;
Include "planar_tract.geo";

l_glottis = newl; Line(l_glottis) = {p_tract_top, p_tract_bottom};
loop = newll;     Curve Loop(loop) = {tract_midline(), l_mouth, -tract_wall(), l_glottis};
s_tract = news;   Plane Surface(s_tract) = {loop};

Physical Surface("tract") = {s_tract};
Physical Surface("room") = {air()};
Physical Curve("glottis") = {l_glottis};
Physical Curve("walls") = {tract_wall()};
Physical Curve("midline") = {tract_midline(), room_midline};
Physical Curve("mouth") = {l_mouth};
Physical Curve("baffle") = {room_baffle};
Physical Curve("open") = {room_arc};

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
