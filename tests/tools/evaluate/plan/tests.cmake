farcell_tests(tools/evaluate/plan DEPS farcell_tools_evaluate_plan)
