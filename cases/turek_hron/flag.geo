has_fluid = 0;
has_flag = 1;
// No flow is singular at the tip here, and theta = 1/2 of csm3, which damps nothing, does not bear the smallest cells
// that serve the flow.
DefineConstant[
  h_tip = 0.0015,           // [m]
  h_clamp = 0.0025          // [m]
];
Include "channel_and_flag.geo";
