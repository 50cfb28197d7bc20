// A block above a duct whose floor is a plane of symmetry. [m]
SetFactory("OpenCASCADE");
h = 0.0001;
Rectangle(1) = {0, 0, 0, 0.002, 0.0003};
Rectangle(2) = {0.0006, 0.0003, 0, 0.0008, 0.0004};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Physical Surface("duct") = {1};
Physical Surface("block") = {2};
eps = 1e-6;
Physical Curve("left") = Curve In BoundingBox{-eps, -eps, -eps, eps, 0.0003 + eps, eps};
Physical Curve("right") = Curve In BoundingBox{0.002 - eps, -eps, -eps, 0.002 + eps, 0.0003 + eps, eps};
Physical Curve("floor") = Curve In BoundingBox{-eps, -eps, -eps, 0.002 + eps, eps, eps};
Physical Curve("drive") = Curve In BoundingBox{0.0006 - eps, 0.0007 - eps, -eps, 0.0014 + eps, 0.0007 + eps, eps};
Physical Curve("face") = Curve In BoundingBox{0.0006 - eps, 0.0003 - eps, -eps, 0.0014 + eps, 0.0003 + eps, eps};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
