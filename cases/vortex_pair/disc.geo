// A disc of air around the origin. In its middle a disc "flow"; cells are small along the circle of radius `orbit`, on
// which vortices go round, and grow away from it. The rim is the group "open". [m]
DefineConstant[
  orbit = 1,                // [m] radius of the vortices' path
  band = 0.3,               // [m] on both sides of the path with the smallest cells
  flow_radius = 20,         // [m] of the disc "flow"
  air_radius = 40,          // [m] of the whole
  h_path = 0.1,             // [m] cell size along the path
  h_air = 2,                // [m] largest cell size
  growth = 0.15,            // of cell size a metre away from the path
  size_factor = 1           // multiplies every cell size
];

Point(1) = {0, 0, 0};
radii() = {orbit, flow_radius, air_radius};
For i In {0 : 2}
  For k In {0 : 3}
    Point(10 * (i + 1) + k) = {radii(i) * Cos(k * Pi / 2), radii(i) * Sin(k * Pi / 2), 0};
  EndFor
  For k In {0 : 3}
    Circle(10 * (i + 1) + k) = {10 * (i + 1) + k, 1, 10 * (i + 1) + (k + 1) % 4};
  EndFor
  Curve Loop(i + 1) = {10 * (i + 1) : 10 * (i + 1) + 3};
EndFor
Plane Surface(1) = {1};
Plane Surface(2) = {2, 1};
Plane Surface(3) = {3, 2};

Field[1] = Distance;
Field[1].CurvesList = {10, 11, 12, 13};
Field[1].NumPointsPerCurve = 200;
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = size_factor * h_path;
Field[2].SizeMax = size_factor * h_air;
Field[2].DistMin = band;
Field[2].DistMax = band + (h_air - h_path) / growth;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Physical Surface("flow") = {1, 2};
Physical Surface("air") = {3};
Physical Curve("open") = {30 : 33};
