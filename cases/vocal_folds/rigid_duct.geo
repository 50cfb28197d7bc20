// The rigid wall of a duct behind a fold, at the height of its base; `Call Duct` draws that of one side after `Call Fold`.
// With false folds there is half an ellipse on the wall behind the ventricle. [m]
//
//    ________             _________      ________| outlet
//            \   fold    |  y = 0  \____/
//             \__________|       false fold
DefineConstant[
  supraglottal_length = 0.03,   // [m]
  false_folds = 0,              // 1: with them
  false_gap = 0.0025,           // [m] half of the gap between them
  false_length = 0.006,         // [m] along x
  ventricle_length = 0.005,     // [m] from the fold to the false fold
  h_outlet = 0.0006,            // [m] at the outlet
  h_false = 0.0003              // [m] at the edge of the false folds
];

// Leaves: outlet_x, point p_outlet in the corner, curves behind() from the fold to there.
Macro Duct
  outlet_x = fold_end_x + supraglottal_length;
  p_outlet = newp; Point(p_outlet) = {outlet_x, fold_base_y, 0, h_outlet};
  behind() = {};
  p = fold_end;
  If (false_folds)
    x = fold_end_x + ventricle_length;
    q = newp; Point(q) = {x, fold_base_y, 0, h_outlet};
    centre = newp; Point(centre) = {x + 0.5 * false_length, fold_base_y, 0, h_outlet};
    edge = newp; Point(edge) = {x + 0.5 * false_length, side * false_gap, 0, h_false};
    end = newp; Point(end) = {x + false_length, fold_base_y, 0, h_outlet};
    l = newl; Line(l) = {p, q};
    behind() += {l};
    l = newl; Ellipse(l) = {q, centre, q, edge};
    behind() += {l};
    l = newl; Ellipse(l) = {edge, centre, end, end};
    behind() += {l};
    p = end;
  EndIf
  l = newl; Line(l) = {p, p_outlet};
  behind() += {l};
Return
