farcell_program(tests/bench/frame bench_frame DEPS farcell_runtime)
