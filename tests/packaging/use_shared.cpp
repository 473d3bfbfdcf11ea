// Uses a shared object that the libraries were linked into.
#include <cstdio>

extern "C" double lowest_frequency_of_wt600();

int main() {
    const double hertz = lowest_frequency_of_wt600();
    std::printf("lowest frequency of the 600 kW machine, by a shared object: %.3f Hz\n", hertz);
    return hertz > 0.1 && hertz < 1 ? 0 : 1;
}
