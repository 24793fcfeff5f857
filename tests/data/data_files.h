#pragma once
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/source_paths.h"

/// The glTF files of the test data, which others wrote, and what must become of each.
namespace gnomon::test {

/// Name (path below the data folder) -> one word: what its picture shows, or the rule that refuses it.
using Verdicts = std::map<std::string, std::string>;

// What a picture shows; no rule has such a name.
inline constexpr const char* kSeen = "seen";              // some pixel shows a surface
inline constexpr const char* kNothing = "nothing";        // the scene places no triangle
inline constexpr const char* kOutOfView = "out_of_view";  // it places some, and no pixel shows one

bool is_picture(const std::string& verdict);

/// Names of all .gltf and .glb files, sorted; empty where the data is absent.
std::vector<std::string> data_files();

/// tests/data/verdicts.txt; only the test on the software device knows enough to write it.
Verdicts recorded_verdicts();
void record_verdicts(const Verdicts& verdicts);

/// Ends the process, naming the file at work, if one takes longer than 20 s of this process's time. Six times that by
/// the clock ends it as well. So a busy machine does not end it too soon, and a thread that sleeps for ever does.
class Watchdog {
public:
    explicit Watchdog(double most_process_s = 20.0);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    /// Starts the time that counts for `file`.
    void watch(const std::string& file);

private:
    void run();

    const double most_process_s_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool done_ = false;
    std::string file_;
    double process_start_s_ = 0.0;
    std::chrono::steady_clock::time_point start_;
    std::thread thread_;
};

}  // namespace gnomon::test
