farcell_tests(cache/base DEPS farcell_cache_base)
