farcell_tests(runtime/gl DEPS farcell_runtime_gl farcell_shaders_shared)
farcell_tests(runtime/camera DEPS farcell_runtime_camera)
farcell_tests(runtime/cost DEPS farcell_runtime_cost)
farcell_tests(runtime/selection DEPS farcell_runtime_selection APART hand_over_test.cpp)
farcell_tests(runtime/draw DEPS farcell_runtime_draw)
farcell_tests(runtime/occlusion DEPS farcell_runtime_occlusion)
farcell_tests(runtime/calibration DEPS farcell_runtime_calibration)
farcell_tests(runtime DEPS farcell_runtime farcell_preprocess_build farcell_datasets_city farcell_tests_support
                            farcell_tests_support_images
                       APART show_gl_test.cpp compose_gl_test.cpp relight_gl_test.cpp)
