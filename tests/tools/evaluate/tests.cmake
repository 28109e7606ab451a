farcell_tests(tools/evaluate DEPS farcell_cache_pack farcell_preprocess_read farcell_shaders_shared
                                  farcell_tools_evaluate_report)
add_dependencies(tools_evaluate_test farcell-evaluate)
