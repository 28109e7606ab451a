farcell_program(tests/bench/near bench_near DEPS farcell_runtime)
farcell_program(tests/bench/near/pattern bench_near_pattern)
