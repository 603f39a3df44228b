#include "host/app/mpi/mpi_runner.h"

#include <fmt/format.h>
#include <mpi.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "host/app/child_runner.h"
#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/core/error.h"

namespace vkdose {

namespace {

using Json = nlohmann::json;

/// The messages between rank 0 and the others; their text is JSON.
enum Tag { kTask = 1, kEnd, kInterrupt, kQuit };

void check(int result, const char* call) {
    if (result != MPI_SUCCESS) throw RunError(fmt::format("{} failed with {}", call, result));
}

void say(int rank, Tag tag, const Json& what) {
    const std::string text = what.dump();
    check(MPI_Send(text.data(), int(text.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD), "MPI_Send");
}

struct Heard {
    int rank;
    int tag;
    Json what;
};

/// A message, if one has come. (Waiting for one would keep a core busy in most MPI libraries.)
std::optional<Heard> hear() {
    int there = 0, size = 0;
    MPI_Status status;
    check(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status), "MPI_Iprobe");
    if (there == 0) return std::nullopt;
    check(MPI_Get_count(&status, MPI_CHAR, &size), "MPI_Get_count");
    std::string text(std::size_t(size), '\0');
    check(MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE),
          "MPI_Recv");
    return Heard{status.MPI_SOURCE, status.MPI_TAG, Json::parse(text)};
}

/// The number of this rank among the ranks on its machine.
int localRank() {
    MPI_Comm machine = MPI_COMM_NULL;
    check(MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine), "MPI_Comm_split_type");
    int rank = 0;
    MPI_Comm_rank(machine, &rank);
    MPI_Comm_free(&machine);
    return rank;
}

/// The life of a rank but the first: what rank 0 says, and what becomes of the member it runs.
void serve(const BackendChoice& choice) {
    ChildRunner own(choice, 1);
    const std::atomic<bool>& stop = watchInterrupts();
    bool interrupted = false;
    for (;;) {
        while (const auto heard = hear()) {
            if (heard->tag == kQuit) return;
            if (heard->tag == kTask)
                own.start({heard->what["number"], heard->what["folder"].get<std::string>(), heard->what["resume"],
                           heard->what["bed"]});
            // A second interrupt would end the member without a checkpoint, and the launcher may have interrupted this
            // rank already.
            if (heard->tag == kInterrupt && !std::exchange(interrupted, true)) own.interrupt();
        }
        if (stop && !std::exchange(interrupted, true)) own.interrupt();
        if (const auto end = own.wait())
            say(0, kEnd, {{"number", end->number}, {"code", end->code}, {"said", end->said}});
    }
}

class MpiRunner : public MemberRunner {
  public:
    MpiRunner(const BackendChoice& choice, int ranks) : own_(choice, 1), ranks_(ranks) {
        for (int rank = 0; rank < ranks; ++rank) idle_.insert(rank);
    }
    ~MpiRunner() override {
        // An error ends the sweep: a member that still runs is interrupted and waited for.
        try {
            if (int(idle_.size()) < ranks_) MpiRunner::interrupt();
            while (int(idle_.size()) < ranks_) (void)MpiRunner::wait();
            for (int rank = 1; rank < ranks_; ++rank) say(rank, kQuit, {});
        } catch (const std::exception& e) {
            tell(stderr, "vkdose: {}\n", e.what());
            MPI_Abort(MPI_COMM_WORLD, 1);
        }
        MPI_Finalize();
    }
    MpiRunner(const MpiRunner&) = delete;
    MpiRunner& operator=(const MpiRunner&) = delete;

    std::string manner() const override { return fmt::format("{} at a time", ranks_); }
    bool settlesBeds() const override { return true; }
    bool takes(const Member&) const override { return !idle_.empty(); }

    void start(const MemberTask& task) override {
        const int rank = *idle_.begin();
        idle_.erase(idle_.begin());
        busy_[task.number] = rank;
        if (rank == 0)
            own_.start(task);
        else
            say(rank, kTask,
                {{"number", task.number},
                 {"folder", std::filesystem::absolute(task.folder).string()},
                 {"resume", task.resume},
                 {"bed", task.bed}});
    }

    std::optional<MemberEnd> wait() override {
        std::optional<MemberEnd> end;
        if (const auto heard = hear())
            end = MemberEnd{heard->what["number"], heard->what["code"], heard->what["said"]};
        else
            end = own_.wait();
        if (end) {
            idle_.insert(busy_.at(end->number));
            busy_.erase(end->number);
        }
        return end;
    }

    void interrupt() override {
        for (const auto& [number, rank] : busy_) {
            if (rank == 0)
                own_.interrupt();
            else
                say(rank, kInterrupt, {});
        }
    }

  private:
    ChildRunner own_;
    int ranks_;
    std::set<int> idle_;
    std::map<int, int> busy_;  ///< rank of each member that runs
};

}  // namespace

std::unique_ptr<MemberRunner> makeMpiRunner(const BackendChoice& choice) {
    check(MPI_Init(nullptr, nullptr), "MPI_Init");
    int rank = 0, ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    // Side by side on a machine, members share its cores best with one thread each.
    setenv("LP_NUM_THREADS", "0", 0);
    const bool onDevice = choice.backend != "reference" && choice.device.empty();
    const BackendChoice own = onDevice ? choiceOfRank(choice, vk::listDevices(), localRank()) : choice;
    if (rank == 0) return std::make_unique<MpiRunner>(own, ranks);
    serve(own);
    MPI_Finalize();
    return nullptr;
}

}  // namespace vkdose
