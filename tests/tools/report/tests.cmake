farcell_tests(tools/report DEPS farcell_tools_report)
