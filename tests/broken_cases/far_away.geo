// Air that the duct of scene.geo does not touch. [m]
h = 0.002;
Point(1) = {0.1, 0, 0, h};    Point(2) = {0.11, 0, 0, h};
Point(3) = {0.11, 0.01, 0, h}; Point(4) = {0.1, 0.01, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};
Curve Loop(1) = {1 : 4};
Plane Surface(1) = {1};
Physical Surface("air") = {1};
Physical Curve("open") = {2};
