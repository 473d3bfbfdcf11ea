/// @file
/// Controllers as shared libraries with the interface of Bladed: a function DISCON that is called once per period and
/// exchanges an array of numbers. The usual form in which turbine controllers are handed on (OpenFAST, Bladed, HAWC2).
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

namespace cardan {

/// A controller in a shared library. It keeps its memory to itself: two controllers in one process need two copies of
/// the library's file, and a run with one cannot continue from a checkpoint.
class BladedController {
public:
    struct Options {
        std::string input = {};         ///< name of a file for the controller (accINFILE)
        std::string output = "cardan";  ///< prefix of files that it writes (avcOUTNAME)
        std::string function = "DISCON";
        int blades = 3;
        double period = 0;  ///< s, between two calls
        double fine_pitch = 0, largest_pitch = 1.5707963267948966, least_pitch_rate = -0.1396,
               largest_pitch_rate = 0.1396;  ///< rad, rad/s: told to the controller, which may have its own
        double rated_speed = 0;              ///< of the generator, rad/s
        double largest_torque = 0;           ///< N m
    };
    /// What the machine tells, SI; a blade's values by its place. Records not named here are zero.
    struct Measured {
        double time = 0;
        std::array<double, 3> pitch{};                ///< records 4, 33, 34, towards feather
        double power = 0;                             ///< 15, electrical
        double generator_speed = 0, rotor_speed = 0;  ///< 20, 21
        double generator_torque = 0;                  ///< 23
        double yaw_error = 0, wind_speed = 0;         ///< 24, 27
        std::array<double, 3> out_of_plane{};         ///< 30 ... 32: moments of the blade roots
        std::array<double, 3> in_plane{};             ///< 69 ... 71
        double yaw = 0;                               ///< 37, of the nacelle
        double tower_acceleration = 0;                ///< 53, of the tower's top, downwind
        double nacelle_nodding = 0;                   ///< 83, angular acceleration
        double azimuth = 0;                           ///< 60
    };
    struct Demand {
        std::array<double, 3> pitch{};  ///< 42 ... 44, or 45 for all where the controller pitches collectively (28 = 0)
        double torque = 0;              ///< 47, of the generator
        double yaw_rate = 0;            ///< 48
        std::string message = {};       ///< what the controller says (avcMSG), if anything
    };

    /// @throws FileError if the library cannot be loaded or has no such function; InputError for bad options
    BladedController(const std::filesystem::path& library, Options options);
    ~BladedController();
    BladedController(const BladedController&) = delete;
    BladedController& operator=(const BladedController&) = delete;

    /// The next call; the first one is an initialisation as well (record 1 = 0).
    /// @throws NumericalError, with the time: the controller reports a failure (aviFAIL < 0) or demands what is no
    /// number
    Demand step(const Measured& now);
    /// The last call (record 1 = -1), which lets the controller close its files. Done by the destructor otherwise.
    void finish();

private:
    class Library;
    void call(double status, const Measured& now);
    void write(const Measured& now);

    std::filesystem::path path_;
    Options own_;
    std::unique_ptr<Library> library_;
    Measured last_;
    bool started_ = false, finished_ = false;
};

}  // namespace cardan
