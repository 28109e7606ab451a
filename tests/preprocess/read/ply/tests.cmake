farcell_tests(preprocess/read/ply DEPS farcell_preprocess_read)
