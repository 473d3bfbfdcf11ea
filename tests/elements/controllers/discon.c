/* A controller with the interface of Bladed, to be loaded by the tests. The first word of its input says what it does:
   follow: torque = 2 * generator speed, pitch = 0.1 * time; nan: demands what is no number from 0.5 s on;
   fail: reports a failure from 0.5 s on; warn: warns from 0.5 s on, in two texts by turns;
   individual: another pitch for every blade, where it is told that it may (record 28);
   off: takes the generator off the grid from 0.5 s on; brake: shaft brake on from 0.5 s on; half: 300 N m of it;
   contactor, brakes: a contactor and a brake that there are not;
   yaw: turns the nacelle with 0.02 rad/s; override: asks for the pitch and the yaw of the machine's own. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#define RECORD(i) swap[(i) - 1]

void DISCON(float* swap, int* fail, char* input, char* output, char* message) {
    static int calls = 0;
    static float contactor, brake;
    const int status = (int)RECORD(1);
    (void)output;
    *fail = 0;
    if (status == 0) {
        calls = 0;
        contactor = 1;
        brake = 0;
        snprintf(message, (size_t)RECORD(49), "%s starts with a period of %g s", input, (double)RECORD(3));
    }
    if (status < 0) return;
    ++calls;
    /* What is switched is told as it was left. */
    if (RECORD(35) != contactor || RECORD(36) != brake) {
        *fail = -2;
        snprintf(message, (size_t)RECORD(49), "contactor %g, brake %g", (double)RECORD(35), (double)RECORD(36));
        return;
    }
    RECORD(47) = 2 * RECORD(20);
    RECORD(45) = 0.1f * RECORD(2);
    if (strcmp(input, "individual") == 0 && RECORD(28) == 1) {
        RECORD(42) = RECORD(4) + 0.01f;
        RECORD(43) = RECORD(33) + 0.02f;
        RECORD(44) = RECORD(34) + 0.03f;
    }
    if (strcmp(input, "yaw") == 0) RECORD(48) = 0.02f;
    if (strcmp(input, "override") == 0) RECORD(55) = RECORD(102) = 1;
    if (RECORD(2) < 0.5f) return;
    if (strcmp(input, "nan") == 0) RECORD(47) = NAN;
    if (strcmp(input, "off") == 0) RECORD(35) = contactor = 0;
    if (strcmp(input, "brake") == 0) RECORD(36) = brake = 1;
    if (strcmp(input, "contactor") == 0) RECORD(35) = 2;
    if (strcmp(input, "brakes") == 0) RECORD(36) = 3;
    if (strcmp(input, "half") == 0) {
        RECORD(36) = brake = 16;
        RECORD(107) = 300;
    }
    if (strcmp(input, "warn") == 0) {
        *fail = 1;
        snprintf(message, (size_t)RECORD(49), calls % 2 ? "the wind vane shakes" : "the oil is cold");
    }
    if (strcmp(input, "fail") == 0) {
        *fail = -1;
        snprintf(message, (size_t)RECORD(49), "the pitch sensor is dead after %d calls", calls);
    }
}
