farcell_tests(preprocess/read/obj DEPS farcell_preprocess_read APART obj_textures_test.cpp)
