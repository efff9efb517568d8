#include "peer_sample.h"

namespace swept {
namespace {

constexpr std::size_t kHeadNumbers = 12;
constexpr std::size_t kBodyNumbers = 7;
constexpr std::size_t kContactNumbers = 6;

}  // namespace

void addMotion(const BodyMotion& body, PeerSample& sample) {
    const double omega = body.angularVelocity;
    sample.energy += 0.5 * body.mass * dot(body.velocity, body.velocity) + 0.5 * body.inertia * omega * omega -
                     body.mass * dot(body.gravity, body.center);
    sample.momentum += body.mass * body.velocity;
    sample.angularMomentum += body.mass * cross(body.center, body.velocity) + body.inertia * omega;
}

void encodeSample(const PeerSample& sample, std::vector<double>& numbers) {
    const Frame& frame = sample.frame;
    numbers = {static_cast<double>(frame.step),
               frame.time,
               static_cast<double>(frame.bodies.size()),
               static_cast<double>(frame.contacts.size()),
               sample.penetration,
               sample.jointError,
               sample.energy,
               sample.momentum.x,
               sample.momentum.y,
               sample.angularMomentum,
               static_cast<double>(sample.brokenJoints),
               sample.stepSeconds};
    for (const BodyFrame& body : frame.bodies) {
        numbers.insert(numbers.end(), {body.position.x, body.position.y, body.angle, body.velocity.x, body.velocity.y,
                                       body.angularVelocity, body.awake ? 1.0 : 0.0});
    }
    for (const ContactFrame& contact : frame.contacts) {
        numbers.insert(numbers.end(), {contact.point.x, contact.point.y, contact.normal.x, contact.normal.y,
                                       contact.separation, contact.impulse});
    }
}

std::optional<PeerSample> decodeSample(std::span<const double> numbers) {
    if (numbers.size() < kHeadNumbers) { return std::nullopt; }
    const auto bodies = static_cast<std::size_t>(numbers[2]);
    const auto contacts = static_cast<std::size_t>(numbers[3]);
    if (numbers.size() != kHeadNumbers + bodies * kBodyNumbers + contacts * kContactNumbers) { return std::nullopt; }
    PeerSample sample;
    sample.frame.step = static_cast<std::int64_t>(numbers[0]);
    sample.frame.time = numbers[1];
    sample.penetration = numbers[4];
    sample.jointError = numbers[5];
    sample.energy = numbers[6];
    sample.momentum = {numbers[7], numbers[8]};
    sample.angularMomentum = numbers[9];
    sample.brokenJoints = static_cast<std::int64_t>(numbers[10]);
    sample.stepSeconds = numbers[11];
    for (std::size_t i = 0; i < bodies; ++i) {
        const auto n = numbers.subspan(kHeadNumbers + i * kBodyNumbers, kBodyNumbers);
        sample.frame.bodies.push_back({{n[0], n[1]}, n[2], {n[3], n[4]}, n[5], n[6] != 0});
    }
    for (std::size_t i = 0; i < contacts; ++i) {
        const auto n = numbers.subspan(kHeadNumbers + bodies * kBodyNumbers + i * kContactNumbers, kContactNumbers);
        sample.frame.contacts.push_back({{n[0], n[1]}, {n[2], n[3]}, n[4], n[5]});
    }
    return sample;
}

}  // namespace swept
