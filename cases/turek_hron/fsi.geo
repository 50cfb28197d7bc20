has_fluid = 1;
has_flag = 1;
Include "channel_and_flag.geo";
