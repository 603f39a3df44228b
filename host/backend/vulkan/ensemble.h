#pragma once
// Canisters that share one device. The same passes step all of them at once. Each canister has its own part of every
// table, its own parameters and its own bodies. The results of a member do not depend on the others in any bit. A
// single canister is an ensemble of one. Only one thread at a time may use an ensemble.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/backend/vulkan/field_passes.h"
#include "host/backend/vulkan/pace.h"
#include "host/backend/vulkan/pack_bodies.h"
#include "host/backend/vulkan/passes.h"
#include "host/backend/vulkan/vulkan.h"

namespace vkdose {

class Ensemble {
  public:
    explicit Ensemble(const VulkanOptions& options);

    struct Canister {
        World world;
        ContactLaw law;
        Particles particles;
    };

    /// Start over with these canisters. All are live. Throws RunError if they do not fit the tables, or cannot share
    /// them (roomForAll).
    void load(const std::vector<Canister>& canisters);

    /// Puts a canister into the place of this member, which is over. Returns false and changes nothing if the tables
    /// have no room for it. Throws RunError if it cannot share them. The member is live after setLive.
    bool replace(std::uint32_t member, const Canister& canister);

    /// Makes tables anew that hold the members that `stay`, which go on as they are, and canisters beside them. Members
    /// are numbered anew: first those who stay, then the others, and all are live. Throws RunError, and changes
    /// nothing, if they cannot share tables.
    void enlarge(const std::vector<std::uint32_t>& stay, const std::vector<Canister>& beside);

    bool isLoaded() const { return passes_ != nullptr; }
    /// How many members there are, those that are over included.
    std::uint32_t size() const { return std::uint32_t(members_.size()); }

    /// The members that step from now on, ascending. Those left out keep their state.
    void setLive(const std::vector<std::uint32_t>& members);

    void setLaw(std::uint32_t member, const ContactLaw& law);
    void setGravity(std::uint32_t member, const Vec3& gravity);
    void addParticles(std::uint32_t member, std::size_t first, const std::vector<Vec3>& positions);
    void setClocks(std::uint32_t member, const std::vector<BodyClock>& clocks);

    /// Advances all live members together. `coilRates` holds the rate of every member [rad/s about +z]. The run error
    /// of a member is kept (`failure`), and its state is of no use from then on.
    void advance(std::uint32_t steps, const std::vector<double>& coilRates);

    /// The error that stopped this member.
    const std::optional<std::string>& failure(std::uint32_t member) const { return members_[member].failure; }

    /// A live member to be sensed. Means are over its last `steps`.
    struct Look {
        std::uint32_t member, steps;
    };
    /// Sensors of each. All are read together, because a device takes as long to answer one question as many.
    std::vector<Sensors> sense(const std::vector<Look>& looks);

    /// As in Backend, of a live member.
    Record snapshot(std::uint32_t member) const;
    void restore(std::uint32_t member, const Record& record);
    Particles particles(std::uint32_t member) const;
    std::vector<FreeBody> freeBodies(std::uint32_t member) const;
    std::vector<Contact> contacts(std::uint32_t member) const;

    /// As in Backend, of a live member.
    FieldPoints fields(std::uint32_t member, const FieldRequest& request);

    /// The profile of an ensemble of one.
    VulkanProfile profile(std::uint32_t steps, double coilRate);

    /// How often the contact lists of a member were made anew since load.
    std::uint32_t refreshes(std::uint32_t member) const { return passes_->controlOf(member).list.w; }

    /// Size of all tables together [bytes]. Call after `load`.
    std::uint64_t tableBytes() const { return passes_->bytes(); }

    const vk::Device& device() const { return device_; }

  private:
    struct MemberState {
        World world;
        std::vector<RigidBody> bodies;  ///< allBodies
        Particles loaded;
        std::shared_ptr<const UserLaw> userLaw;
        gpu::Member block{};
        std::uint64_t step = 0;
        std::uint32_t made = 0;           ///< the same modulo 2^32 (gpu::Control::steps)
        std::int64_t drive = 0;           ///< of the drive since load [kDrive turns]; the same for any batches
        std::vector<BodyClock> clocks;    ///< of bodies that move in phases; empty: they stand
        bool moves = false;               ///< one of its bodies
        bool free = false;                ///< one of its bodies moves freely
        std::vector<gpu::BodyMotion> at;  ///< of the bodies that move freely: as in the next step
        std::vector<gpu::vec4> around;    ///< of each body: a sphere around it in its own frame: centre, radius [m]
        /// Of each body that turns about the z axis of its frame: how much nearer it comes at most [m per s or rad].
        std::vector<std::optional<double>> approach;
        std::uint32_t shapes = 0;  ///< room for those of its bodies
        std::uint32_t row = 0;     ///< on the roster
        std::optional<std::string> failure;

        std::uint32_t half() const { return made % 2; }             ///< of the state, which is current
        std::uint32_t late() const { return made % gpu::kStride; }  ///< steps since a stride could begin
    };

    /// Members and all that is known of their tables before these are made.
    struct Plan {
        std::vector<MemberState> members;
        DeviceShape shape;
        TableSizes sizes;
        std::vector<gpu::uvec4> shapes;  ///< of the bodies of all
    };
    static MemberState newMember(const Canister& c);
    static TableSizes sizesOf(const MemberState& m, std::uint32_t members, const DeviceShape& shape);
    /// Throws RunError if they cannot share tables.
    Plan planFor(std::vector<MemberState> members) const;
    /// Replaces the tables by those of the plan, without history.
    void make(Plan plan);

    // ensemble_bodies.cpp
    /// How far the drive goes in a step [kDrive turns].
    static std::int64_t drivePerStep(double rate, double dt);
    /// Packs the bodies of a member for passes of these sizes, which learn what shapes there are.
    static PackedBodies packedBodies(MemberState& m, TableSizes& sizes);
    static void packAllBodies(Plan& plan);
    void makeBodies(Plan& plan);
    /// Sets how many steps of all motions the table holds. Returns false if it does not hold any.
    bool boundBatch();
    /// Where the loads on its bodies are.
    std::vector<vk::Buffer::Part> loadRows(std::uint32_t member) const;
    void writeMotions(std::uint32_t count, const std::vector<double>& coilRates);
    /// The loads on the bodies of each since it was last sensed, which start anew.
    std::vector<std::vector<BodyLoad>> takeLoads(const std::vector<Look>& looks);
    // ensemble_free.cpp, the bodies that move freely
    /// At their start.
    static void placeFree(MemberState& m);
    /// What is prescribed to a body that moves freely: how it stands and turns, were it at its start, and what drives
    /// it along its line [N] or about its hinge [N m].
    struct Driven {
        geometry::Pose pose;
        Vec3 spin{0};
        double drive = 0;
    };
    /// Body `b` in step `n` of the next batch, as far as the host can tell: the device goes on from the first one.
    static gpu::BodyMotion motionOfFree(const MemberState& m, std::size_t b, std::uint32_t n, const Driven& driven);
    /// After a batch of so many steps.
    void readFree(MemberState& m, std::uint32_t count) const;
    static void saveFree(const MemberState& m, Record& record);
    static void restoreFree(const Record& record, std::uint64_t step, MemberState& m);

    void writeBlocks();
    /// `count` steps of every live member.
    void runBatch(std::uint32_t count, const std::vector<double>& coilRates, PassTimes* times = nullptr);
    /// Submits `count` steps. Returns how many of the batch are left to the member that made fewest.
    std::uint32_t submit(std::uint32_t count, bool opening, PassTimes* times);
    /// Before the steps of the batch are counted.
    void keepError(std::uint32_t member, const gpu::uvec4& error);

    VulkanOptions options_;
    vk::Device device_;
    DeviceShape shape_;                   ///< for which the tables are sized
    std::unique_ptr<BodyTables> bodies_;  ///< null if no member has bodies
    std::uint32_t mostBatch_ = 0;         ///< steps for which there is room in the motions of the bodies
    std::unique_ptr<Passes> passes_;
    std::unique_ptr<FieldPasses> fieldPasses_;  ///< made when fields are asked for; after the tables they read
    /// The recordings of steps, by their number. They hold while the same members are live.
    std::map<std::uint32_t, vk::Commands> recorded_;
    std::vector<MemberState> members_;
    std::vector<std::uint32_t> live_;
    Pace pace_{16, 4096};  // steps
};

}  // namespace vkdose
