// A square bracket too few.
Point(1) = {0, 0, 0, 0.5;
