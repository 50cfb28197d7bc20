// A vocal tract, straight and circular, with a half ball of air behind an infinite baffle. [m]
//
// x runs from the glottis (0) to the mouth. The areas are those of stations, glottis and mouth among them, or, where there
// are no stations, of sections of equal length: each then is that of the section's centre, and the first and the last half
// section are cylinders. Between, the radius sqrt(area / pi) is linear. The profile is turned about the x axis in quarter
// turns: `quarters` = 4 is the whole tract; 1 or 2 keep the cells y > 0 (and z > 0) with rigid planes "symmetry", the same
// physics for a quarter or half of the cost (nothing here depends on the angle below the first cross mode, 7 kHz).
//
// Of a circle the mesh has a polygon, of less area: each radius is that of the polygon of the right area. A `wedge` of a few
// degrees, one cell thick, is the same sound at the price of a plane mesh; its sections all shrink alike.
Include "area_function.geo";

DefineConstant[
  stations() = {{}},        // [station_unit] distance of each area from the glottis, the first 0; none: sections
  station_unit = 1,         // [m] of the stations: 1e-2 if they are in cm
  quarters = 4,             // 1, 2 or 4
  wedge = 0,                // [degrees] a wedge instead of quarters
  cells_across = 3.5,       // cells across the diameter, at least
  h_tract = 0.0035,         // [m] largest cell of the tract
  h_mouth = 0.001,          // [m] largest cell at the mouth, whose edge is sharp
  h_growth = 0.25,          // cell size may grow by this much per metre along the axis
  room_radius = 0.06,       // [m] centre: the mouth's
  h_room = 0.006,           // [m] largest cell of the room
  size_factor = 1           // multiplies every cell size
];

// Points of the profile: position, radius, cell size.
If (#stations() == 0)
  last = sections + 1;  // glottis, centres of sections, mouth
  For i In {0 : last}
    j = i == 0 ? 0 : (i == last ? sections - 1 : i - 1);
    station_x(i) = i == 0 ? 0 : (i == last ? sections * section_length : (i - 0.5) * section_length);
    station_r(i) = Sqrt(area(j) / Pi);
  EndFor
Else
  If (#stations() != sections || stations(0) != 0)
    Error("stations must be as many as areas, the first 0");
  EndIf
  last = sections - 1;
  For i In {0 : last}
    station_x(i) = stations(i) * station_unit;
    station_r(i) = Sqrt(area(i) / Pi);
  EndFor
EndIf
mouth_x = station_x(last);
For i In {0 : last}
  station_h(i) = 2 * station_r(i) / cells_across < h_tract ? 2 * station_r(i) / cells_across : h_tract;
EndFor
station_h(last) = station_h(last) < h_mouth ? station_h(last) : h_mouth;
For i In {1 : last}
  limit = station_h(i - 1) + h_growth * (station_x(i) - station_x(i - 1));
  station_h(i) = station_h(i) < limit ? station_h(i) : limit;
EndFor
For i In {1 : last}
  j = last - i;
  limit = station_h(j + 1) + h_growth * (station_x(j + 1) - station_x(j));
  station_h(j) = station_h(j) < limit ? station_h(j) : limit;
EndFor

// Edges of a quarter of the polygon, and its corners' radius.
For i In {0 : last}
  station_n(i) = Ceil(Pi / 2 * station_r(i) / (station_h(i) * size_factor));
  half_angle = Pi / 4 / station_n(i);
  station_r(i) *= wedge > 0 ? 1 : Sqrt(2 * half_angle / Sin(2 * half_angle));
EndFor

// Half profile in the plane z = 0: one surface for the tract and one for the room.
For i In {0 : last}
  bottom = newp; Point(bottom) = {station_x(i), 0, 0, station_h(i)};
  top = newp;    Point(top) = {station_x(i), station_r(i), 0, station_h(i)};
  If (i == 0)
    l_glottis = newl; Line(l_glottis) = {top, bottom};
  Else
    l = newl; Line(l) = {previous_bottom, bottom}; axis(i - 1) = l;
    l = newl; Line(l) = {previous_top, top};       wall(i - 1) = l;
  EndIf
  previous_bottom = bottom;
  previous_top = top;
EndFor
l_mouth = newl;  Line(l_mouth) = {previous_bottom, previous_top};
far = newp;      Point(far) = {mouth_x + room_radius, 0, 0, h_room};
edge = newp;     Point(edge) = {mouth_x, room_radius, 0, h_room};
l_axis = newl;   Line(l_axis) = {previous_bottom, far};
l_open = newl;   Circle(l_open) = {far, previous_bottom, edge};
l_baffle = newl; Line(l_baffle) = {edge, previous_top};
loop = newll; Curve Loop(loop) = {axis(), l_mouth, -wall(), l_glottis};
s_tract = news; Plane Surface(s_tract) = {loop};
loop = newll; Curve Loop(loop) = {l_axis, l_open, l_baffle, -l_mouth};
s_room = news; Plane Surface(s_room) = {loop};

// Extrude answers: end surface, volume, then one surface for each curve of the loop that is not on the axis, in order: of
// the tract the mouth, the walls back to the glottis, the glottis.
first_tract = s_tract;
first_room = s_room;
v_tract() = {}; v_room() = {};
g_walls() = {}; g_glottis() = {}; g_mouth() = {}; g_open() = {}; g_baffle() = {};
turns = wedge > 0 ? 1 : quarters;
For q In {1 : turns}
  If (wedge > 0)
    tract() = Extrude { {1, 0, 0}, {0, 0, 0}, wedge * Pi / 180 } { Surface{s_tract}; Layers{1}; };
    room() = Extrude { {1, 0, 0}, {0, 0, 0}, wedge * Pi / 180 } { Surface{s_room}; Layers{1}; };
  Else
    tract() = Extrude { {1, 0, 0}, {0, 0, 0}, Pi / 2 } { Surface{s_tract}; };
    room() = Extrude { {1, 0, 0}, {0, 0, 0}, Pi / 2 } { Surface{s_room}; };
    For i In {1 : last}
      sides() = Abs(Boundary { Surface{tract(2 + i)}; });
      Transfinite Curve {sides(1)} = station_n(last - i) + 1;
      Transfinite Curve {sides(3)} = station_n(last - i + 1) + 1;
    EndFor
  EndIf
  s_tract = tract(0);
  v_tract() += tract(1);
  g_mouth() += tract(2);
  g_walls() += tract({3 : #tract() - 2});
  g_glottis() += tract(#tract() - 1);
  s_room = room(0);
  v_room() += room(1);
  g_open() += room(2);
  g_baffle() += room(3);
EndFor

Physical Volume("tract") = {v_tract()};
Physical Volume("room") = {v_room()};
Physical Surface("glottis") = {g_glottis()};
Physical Surface("walls") = {g_walls()};
Physical Surface("mouth") = {g_mouth()};
Physical Surface("baffle") = {g_baffle()};
Physical Surface("open") = {g_open()};
If (turns < 4)
  Physical Surface("symmetry") = {first_tract, first_room, s_tract, s_room};
EndIf

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Optimize = 1;
