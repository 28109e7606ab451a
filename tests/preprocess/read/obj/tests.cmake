farcell_tests(preprocess/read/obj DEPS farcell_preprocess_read)
