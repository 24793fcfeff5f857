#pragma once

/// An OpenGL context that Gnomon knows nothing of, current on this thread while it lives.
class OwnContext {
public:
    OwnContext();
    ~OwnContext();
    OwnContext(const OwnContext&) = delete;
    OwnContext& operator=(const OwnContext&) = delete;
    explicit operator bool() const { return context_ != nullptr; }

private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};
