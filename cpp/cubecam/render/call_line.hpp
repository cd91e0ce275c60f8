#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

namespace cubecam {

/// The line in which the calls of a renderer stand: one is drawn after the other, in the order in
/// which they were made, those that a thread draws later among them.
class CallLine {
public:
    /// A place in the line. It is left when the object ends, wherever it stands then.
    class Place {
    public:
        explicit Place(CallLine& line);  ///< at the end
        ~Place();
        Place(const Place&) = delete;
        Place& operator=(const Place&) = delete;

        /// Waits until everything before this place has left. Polls.
        void wait();

    private:
        CallLine& line_;
    };

    /// The turn of a call on this thread, which is waited for. Three kinds of calls have no place
    /// of their own: those of the thread that serves the line, since whatever it waited for would
    /// wait for it; those of a signal handler that interrupts a wait, which have the place of that
    /// wait; and those of a forked child, which draw nothing.
    class Turn {
    public:
        explicit Turn(CallLine& line);
        ~Turn();
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        friend class CallLine;
        CallLine& line_;
        Turn* const outer_;  ///< of this thread, in any line
        std::optional<Place> place_;
    };

    CallLine();

    /// From now on this thread draws what others put into the line, and nothing else.
    void serve_here() const;
    bool served_here() const;
    /// Whether a call of this thread waits in the line or is being drawn.
    bool called_here() const;

private:
    Place* place_here() const;

    const std::uint64_t number_;  ///< of this line, in the process
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<const Place*> places_;
};

}  // namespace cubecam
