farcell_program(tests/bench/errors bench_errors DEPS farcell_cache_pack)
