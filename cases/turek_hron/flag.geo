has_fluid = 0;
has_flag = 1;
Include "channel_and_flag.geo";
