#pragma once
#include <string>
#include <vector>

namespace gnomon::counted_zones {

inline std::vector<std::string> entered;
inline int open = 0;

struct Zone {
    explicit Zone(const char* name) {
        entered.emplace_back(name);
        ++open;
    }
    ~Zone() { --open; }
    Zone(const Zone&) = delete;
    Zone& operator=(const Zone&) = delete;
};

}  // namespace gnomon::counted_zones

#define GNOMON_ZONE(name) const ::gnomon::counted_zones::Zone gnomon_zone(name)
