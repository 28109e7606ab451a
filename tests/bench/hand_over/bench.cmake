farcell_program(tests/bench/hand_over bench_hand_over DEPS farcell_runtime)
