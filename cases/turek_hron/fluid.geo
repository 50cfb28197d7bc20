has_fluid = 1;
has_flag = 0;
Include "channel_and_flag.geo";
