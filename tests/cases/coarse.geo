// The air of channel.geo and a room behind it, with cells of its own. [m]
DefineConstant[ h = 0.001 ];
Point(1) = {0, 0, 0, h};         Point(2) = {0.004, 0, 0, h};     Point(3) = {0.004, 0.001, 0, h};
Point(4) = {0.006, 0.001, 0, h}; Point(5) = {0.006, 0, 0, h};     Point(6) = {0.03, 0, 0, 3 * h};
Point(7) = {0.03, 0.003, 0, 3 * h}; Point(8) = {0, 0.003, 0, h};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 5};
Line(5) = {5, 6};  Line(6) = {6, 7};  Line(7) = {7, 8};  Line(8) = {8, 1};
Curve Loop(1) = {1 : 8};
Plane Surface(1) = {1};
Physical Surface("duct") = {1};
Physical Curve("glottis") = {8};
Physical Curve("walls") = {1, 2, 3, 4, 5, 7};
Physical Curve("open") = {6};
