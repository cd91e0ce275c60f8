#include "cubecam/trial/verdict.hpp"

#include <csignal>

namespace cubecam::trial {
namespace {

std::string signal_in_words(int number) {
    switch (number) {
        case SIGSEGV: return "SIGSEGV, an access to memory that it does not have";
        case SIGFPE: return "SIGFPE, an arithmetic error";
        case SIGABRT: return "SIGABRT, it gave up";
        case SIGBUS: return "SIGBUS, an access to memory that it does not have";
        case SIGILL: return "SIGILL, an instruction that the processor does not know";
        default: return "signal " + std::to_string(number);
    }
}

std::string step_in_words(Step step) {
    switch (step) {
        case Step::start: break;
        case Step::compile: return " while it compiled this source";
        case Step::link: return " while it linked the program of this source";
        case Step::draw: return " while it drew one pixel with this source";
    }
    return "";
}

}  // namespace

bool Verdict::lasting() const {
    if (outcome == Outcome::out_of_time) return signal == SIGPROF;
    if (outcome == Outcome::out_of_memory) return signal == 0;
    return known();
}

std::string in_words(const Verdict& verdict) {
    const std::string step = step_in_words(verdict.step);
    switch (verdict.outcome) {
        case Outcome::crashed:
            return "the driver crashed (" + signal_in_words(verdict.signal) + ")" + step;
        case Outcome::ended: return "the driver ended its process" + step;
        case Outcome::out_of_time:
            if (verdict.signal != SIGPROF) {
                return "the driver waited for " + std::to_string(Limits::wall_seconds) +
                       " seconds" + step;
            }
            return "the driver took more than " + std::to_string(Limits::seconds) + " seconds" +
                   step;
        case Outcome::out_of_memory:
            if (verdict.signal != 0) {
                return "the driver needed more than half of the memory that this machine has left" +
                       step;
            }
            return "the driver needed more than " + std::to_string(Limits::bytes >> 20) +
                   " MiB of memory" + step;
        case Outcome::killed: return "the process that tried this source was killed twice";
        default: return "the source passed";
    }
}

}  // namespace cubecam::trial
