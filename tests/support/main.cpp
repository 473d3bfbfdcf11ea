// main() of every test program; Catch2 version 2 is compiled here, once.
#define CATCH_CONFIG_RUNNER
#include "tests/support/catch.hpp"

int main(int argc, char* argv[]) {
    Catch::Session session;
#if CARDAN_CATCH_VERSION >= 3
    session.configData().allowZeroTests = true;  // a program without [slow] tests passes when asked for them
#endif
    return session.run(argc, argv);
}
