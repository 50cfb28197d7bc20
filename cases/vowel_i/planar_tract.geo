// The plane half tract of /i/ from x = tract_wall_start to the mouth, and the room in front of it. Included by larynx.geo
// and tract_2d.geo after `tract_start` (where the area function begins) and `tract_wall_start` (where its wall does) are
// set. y = 0 is the symmetry line; the half height is area / (2 depth), linear between the centres of sections, constant
// in the first and the last half section.
// Leaves: p_tract_bottom, p_tract_top (start of midline and wall), tract_midline(), tract_wall() (from start to mouth),
// flow_midline(), flow_wall(), l_outlet (as far as air flows: `flow_sections`), l_mouth, surfaces air() (of the rest of
// the tract, if any, and of the room), curves room_midline, room_baffle, room_arc.
Include "area_function.geo";

DefineConstant[
  depth = 0.015,            // [m] length of the glottis, turns areas into heights
  h_tract = 0.0008,         // [m] largest cell of the tract
  cells_across = 3,         // at least this many cells across the half height
  h_growth = 0.2,           // cell size may grow by this much per metre along the axis
  flow_sections = 1000,     // sections that air flows through; sound alone goes on from there
  room_radius = 0.08,       // [m] quarter disc around the mouth's centre
  h_room = 0.0045           // [m] largest cell of the room
];

mouth_x = tract_start + sections * section_length;

// Cell sizes of the stations (start, centres, mouth), then limited from both sides so that they vary smoothly.
n = 0;
station_x() = {};
station_y() = {};
For i In {-1 : sections}
  x = tract_start + (i + 0.5) * section_length;
  If (i == -1)
    x = tract_wall_start;
    t = (x - tract_start) / section_length - 0.5;
    j = t < 0 ? 0 : Floor(t);
    t = t < 0 ? 0 : t - j;
    y = ((1 - t) * area(j) + t * area(j + 1)) / (2 * depth);
  ElseIf (i == sections)
    x = mouth_x;
    y = area(sections - 1) / (2 * depth);
  Else
    y = area(i) / (2 * depth);
  EndIf
  // A centre that lies before the wall's start, or so near that a sliver would come of it, is left out.
  If (i == -1 || x > tract_wall_start + 0.1 * section_length)
    station_x(n) = x;
    station_y(n) = y;
    n += 1;
  EndIf
EndFor
station_h() = {};
For i In {0 : n - 1}
  station_h(i) = station_y(i) / cells_across < h_tract ? station_y(i) / cells_across : h_tract;
EndFor
For i In {1 : n - 1}
  limit = station_h(i - 1) + h_growth * (station_x(i) - station_x(i - 1));
  station_h(i) = station_h(i) < limit ? station_h(i) : limit;
EndFor
For i In {1 : n - 1}
  j = n - 1 - i;
  limit = station_h(j + 1) + h_growth * (station_x(j + 1) - station_x(j));
  station_h(j) = station_h(j) < limit ? station_h(j) : limit;
EndFor

tract_midline() = {};
tract_wall() = {};
For i In {0 : n - 1}
  bottom = newp; Point(bottom) = {station_x(i), 0, 0, station_h(i)};
  top = newp;    Point(top) = {station_x(i), station_y(i), 0, station_h(i)};
  If (i == 0)
    p_tract_bottom = bottom;
    p_tract_top = top;
  Else
    l = newl; Line(l) = {previous_bottom, bottom}; tract_midline(i - 1) = l;
    l = newl; Line(l) = {previous_top, top};       tract_wall(i - 1) = l;
  EndIf
  previous_bottom = bottom;
  previous_top = top;
  If (station_x(i) < tract_start + (flow_sections + 0.01) * section_length)
    flow_end = i;
    p_flow_bottom = bottom;
    p_flow_top = top;
  EndIf
EndFor
p_mouth_bottom = previous_bottom;
p_mouth_top = previous_top;
l_mouth = newl; Line(l_mouth) = {p_mouth_bottom, p_mouth_top};

p_room_axis = newp;   Point(p_room_axis) = {mouth_x + room_radius, 0, 0, h_room};
p_room_baffle = newp; Point(p_room_baffle) = {mouth_x, room_radius, 0, h_room};
room_midline = newl;  Line(room_midline) = {p_mouth_bottom, p_room_axis};
room_arc = newl;      Circle(room_arc) = {p_room_axis, p_mouth_bottom, p_room_baffle};
room_baffle = newl;   Line(room_baffle) = {p_room_baffle, p_mouth_top};
loop = newll;         Curve Loop(loop) = {room_midline, room_arc, room_baffle, -l_mouth};
s_room = news;        Plane Surface(s_room) = {loop};

air() = {s_room};
flow_midline() = tract_midline();
flow_wall() = tract_wall();
l_outlet = l_mouth;
If (flow_end < n - 1)
  flow_midline() = tract_midline({0 : flow_end - 1});
  flow_wall() = tract_wall({0 : flow_end - 1});
  l_outlet = newl; Line(l_outlet) = {p_flow_bottom, p_flow_top};
  loop = newll;
  Curve Loop(loop) = {tract_midline({flow_end : n - 2}), l_mouth, -tract_wall({flow_end : n - 2}), -l_outlet};
  s_tract = news; Plane Surface(s_tract) = {loop};
  air() += {s_tract};
EndIf
