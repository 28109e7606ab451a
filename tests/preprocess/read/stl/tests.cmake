farcell_tests(preprocess/read/stl DEPS farcell_preprocess_read)
