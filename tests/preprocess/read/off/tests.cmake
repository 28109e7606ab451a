farcell_tests(preprocess/read/off DEPS farcell_preprocess_read)
