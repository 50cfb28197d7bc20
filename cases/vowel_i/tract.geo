// The vocal tract of /i/, straight and circular, with a half ball of air behind an infinite baffle. [m]
//
// x runs from the glottis (0) to the mouth (42 * 0.396825 cm). The radius sqrt(area / pi) is linear between the centres of
// sections and constant in the first and the last half section. The profile is turned about the x axis in quarter turns:
// `quarters` = 4 is the whole tract; 1 or 2 keep the cells y > 0 (and z > 0) with rigid planes "symmetry", the same
// physics for a quarter or half of the cost (nothing here depends on the angle below the first cross mode, 7 kHz).
Include "story_i.geo";

DefineConstant[
  quarters = 4,             // 1, 2 or 4
  cells_across = 3.5,       // cells across the diameter, at least
  h_tract = 0.0035,         // [m] largest cell of the tract
  h_growth = 0.25,          // cell size may grow by this much per metre along the axis
  room_radius = 0.06,       // [m] centre: the mouth's
  h_room = 0.006,           // [m] largest cell of the room
  size_factor = 1           // multiplies every cell size
];

mouth_x = sections * section_length;
last = sections + 1;  // stations: glottis, centres of sections, mouth
For i In {0 : last}
  j = i == 0 ? 0 : (i == last ? sections - 1 : i - 1);
  station_x(i) = i == 0 ? 0 : (i == last ? mouth_x : (i - 0.5) * section_length);
  station_r(i) = Sqrt(areas(j) / Pi);
  station_h(i) = 2 * station_r(i) / cells_across < h_tract ? 2 * station_r(i) / cells_across : h_tract;
EndFor
For i In {1 : last}
  limit = station_h(i - 1) + h_growth * (station_x(i) - station_x(i - 1));
  station_h(i) = station_h(i) < limit ? station_h(i) : limit;
EndFor
For i In {1 : last}
  j = last - i;
  limit = station_h(j + 1) + h_growth * (station_x(j + 1) - station_x(j));
  station_h(j) = station_h(j) < limit ? station_h(j) : limit;
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

// Extrude answers: end surface, volume, then one surface for each curve of the loop that is not on the axis, in order.
first_tract = s_tract;
first_room = s_room;
v_tract() = {}; v_room() = {};
g_walls() = {}; g_glottis() = {}; g_mouth() = {}; g_open() = {}; g_baffle() = {};
For q In {1 : quarters}
  out() = Extrude { {1, 0, 0}, {0, 0, 0}, Pi / 2 } { Surface{s_tract}; };
  s_tract = out(0);
  v_tract() += out(1);
  g_mouth() += out(2);
  For i In {3 : #out() - 2}
    g_walls() += out(i);
  EndFor
  g_glottis() += out(#out() - 1);
  out() = Extrude { {1, 0, 0}, {0, 0, 0}, Pi / 2 } { Surface{s_room}; };
  s_room = out(0);
  v_room() += out(1);
  g_open() += out(2);
  g_baffle() += out(3);
EndFor

Physical Volume("tract") = {v_tract()};
Physical Volume("room") = {v_room()};
Physical Surface("glottis") = {g_glottis()};
Physical Surface("walls") = {g_walls()};
Physical Surface("mouth") = {g_mouth()};
Physical Surface("baffle") = {g_baffle()};
Physical Surface("open") = {g_open()};
If (quarters < 4)
  Physical Surface("symmetry") = {first_tract, first_room, s_tract, s_room};
EndIf

Mesh.MeshSizeFactor = size_factor;
Mesh.Algorithm = 6;
Mesh.Optimize = 1;
