farcell_program(tests/bench/impostors bench_impostors DEPS farcell_runtime)
