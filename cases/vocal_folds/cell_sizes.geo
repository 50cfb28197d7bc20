// Finer at medial() (the medial faces of all folds) and in the jet behind the folds' end at jet_x; elsewhere the points'
// sizes rule. Included last; h_far is the largest size of all points.
DefineConstant[
  fine_distance = 0.0003,       // [m] from the medial faces over which cells are of h_glottis
  h_jet = 0.00022,              // [m] behind the glottis, over jet_length and up to jet_height from y = 0
  jet_length = 0.015,           // [m]
  jet_height = 0.0016,          // [m]
  h_far = 0.0045,               // [m] 3 cm from all this, in open air
  size_factor = 1               // multiplies every cell size
];
Field[1] = Distance;
Field[1].CurvesList = {medial()};
Field[1].NumPointsPerCurve = 60;
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = h_glottis;
Field[2].SizeMax = h_far;
Field[2].DistMin = fine_distance;
Field[2].DistMax = 0.03;
Field[3] = Box;
Field[3].XMin = jet_x;
Field[3].XMax = jet_x + jet_length;
Field[3].YMin = -jet_height;
Field[3].YMax = jet_height;
Field[3].VIn = h_jet;
Field[3].VOut = h_far;
Field[3].Thickness = 0.03;
Field[4] = Min;
Field[4].FieldsList = {2, 3};
Background Field = 4;

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Smoothing = 10;
