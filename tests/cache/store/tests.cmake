farcell_tests(cache/store DEPS farcell_cache_store)
