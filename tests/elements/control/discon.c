/* A controller with the interface of Bladed, to be loaded by the tests. The first word of its input says what it does:
   follow: torque = 2 * generator speed, pitch = 0.1 * time; nan: demands what is no number from 0.5 s on;
   fail: reports a failure from 0.5 s on; individual: another pitch for every blade. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#define RECORD(i) swap[(i) - 1]

void DISCON(float* swap, int* fail, char* input, char* output, char* message) {
    static int calls = 0;
    const int status = (int)RECORD(1);
    (void)output;
    *fail = 0;
    if (status == 0) {
        calls = 0;
        snprintf(message, (size_t)RECORD(49), "%s starts with a period of %g s", input, (double)RECORD(3));
    }
    if (status < 0) return;
    ++calls;
    RECORD(47) = 2 * RECORD(20);
    RECORD(45) = 0.1f * RECORD(2);
    RECORD(28) = 0;
    if (strcmp(input, "individual") == 0) {
        RECORD(28) = 1;
        RECORD(42) = RECORD(4) + 0.01f;
        RECORD(43) = RECORD(33) + 0.02f;
        RECORD(44) = RECORD(34) + 0.03f;
    }
    if (RECORD(2) < 0.5f) return;
    if (strcmp(input, "nan") == 0) RECORD(47) = NAN;
    if (strcmp(input, "fail") == 0) {
        *fail = -1;
        snprintf(message, (size_t)RECORD(49), "the pitch sensor is dead after %d calls", calls);
    }
}
