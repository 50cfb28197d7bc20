// Named curves without any area.
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5};
Line(1) = {1, 2};
Physical Curve("inlet") = {1};
