farcell_tests(tools/evaluate DEPS farcell_cache_pack farcell_preprocess_read farcell_shaders_shared
                                  farcell_tools_evaluate_report farcell_tools_image)
add_dependencies(tools_evaluate_test farcell-evaluate)
