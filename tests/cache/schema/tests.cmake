farcell_tests(cache/schema DEPS farcell_cache_schema)
