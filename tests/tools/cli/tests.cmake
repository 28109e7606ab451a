farcell_tests(tools/cli DEPS farcell_tools_cli)
