farcell_tests(tools/evaluate/baselines DEPS farcell_tools_evaluate_baselines farcell_preprocess_read
                                            farcell_shaders_shared)
