/// @file
/// Controllers as shared libraries with the interface of Bladed: a function DISCON that is called once per period and
/// exchanges an array of numbers. The usual form in which turbine controllers are handed on (OpenFAST, Bladed, HAWC2).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace cardan {

/// A controller in a shared library. It keeps its memory to itself: two controllers in one process need two copies of
/// the library's file, and a run with one cannot continue from a checkpoint.
///
/// Records count from 1, as in the manuals; units are SI. What the machine decides is given before the first call and
/// stays: pitch angles are demanded, not rates (record 10 = 0), yaw rates, not torques (29 = 0), of the blades alike or
/// each (28). What the controller switches is given back to it as it stands: the contactor of the generator (35, on at
/// first) and the shaft brake (36, off at first).
class BladedController {
public:
    struct Options {
        std::string input = {};         ///< name of a file for the controller (accINFILE)
        std::string output = "cardan";  ///< prefix of files that it writes (avcOUTNAME)
        std::string function = "DISCON";
        int blades = 3;
        double period = 0;              ///< s, between two calls
        bool individual_pitch = false;  ///< 28: every blade has a demand of its own
        double fine_pitch = 0, max_pitch = 1.5707963267948966, min_pitch_rate = -0.1396,
               max_pitch_rate = 0.1396;  ///< rad, rad/s: given to the controller, which may have its own
        double rated_speed = 0;          ///< of the generator, rad/s
        double max_torque = 0;           ///< N m
    };
    /// Measured values that the controller is given, SI; a blade's values by its place. Records not named here are
    /// zero.
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
    struct Brake {
        enum class Status : std::uint8_t { off, on, torque };
        Status status = Status::off;  ///< 36: 0, 1, or 16 with a torque of its own
        double torque = 0;            ///< 107, N m, where that is asked for
    };
    struct Demand {
        std::array<double, 3> pitch{};    ///< 42 ... 44, or 45 for all where the pitch is collective
        bool generator_connected = true;  ///< 35: 1, or 0 for off
        double torque = 0;                ///< 47, of the generator; 0 where it is off
        Brake brake = {};                 ///< of the shaft
        double yaw_rate = 0;              ///< 48
        std::string message = {};         ///< what the controller says (avcMSG), if anything
        /// Texts for the user, each once in a run: warnings of the controller (aviFAIL > 0), and demands that are not
        /// obeyed, because nothing here can: overrides of pitch and torque (55, 56), control of the yaw (102).
        std::vector<std::string> remarks = {};
    };

    /// @throws FileError if the library cannot be loaded or has no such function; InputError for bad options
    BladedController(const std::filesystem::path& library, Options options);
    /// The system's words on a library that cannot be loaded here; empty: it can. What it runs on loading, it runs.
    static std::string why_not_loaded(const std::filesystem::path& library);
    ~BladedController();
    BladedController(const BladedController&) = delete;
    BladedController& operator=(const BladedController&) = delete;

    /// The next call; the first one is an initialisation as well (record 1 = 0).
    /// @throws NumericalError, with the time: the controller reports a failure (aviFAIL < 0), demands what is no
    /// number, or a contactor or a brake that there is not
    Demand step(const Measured& now);
    /// The last call (record 1 = -1), which lets the controller close its files. Done by the destructor otherwise.
    void finish();

private:
    class Library;
    void call(double status, const Measured& now, std::vector<std::string>& remarks);
    void write(const Measured& now);
    Demand read() const;
    void remark(const std::string& words, std::vector<std::string>& remarks);

    std::filesystem::path path_;
    Options own_;
    std::unique_ptr<Library> library_;
    Measured last_;
    bool started_ = false, finished_ = false;
    std::set<std::string> told_;  ///< remarks
};

}  // namespace cardan
