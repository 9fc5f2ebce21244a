/*
 * zhuyi: how often must each camera's frames be processed?  The C face of the estimator.
 *
 * SI units; the first token of a number's comment is its unit. d, yaw and headings are positive to the left
 * (counter-clockwise). s and d are of any one straight or road-aligned frame, x and y of any one plane; the
 * reference point of a vehicle is the centre of its box. No number may be NaN, infinite or beyond 1e12.
 *
 * Functions that can fail return a zhuyi_status. On anything but ZHUYI_STATUS_OK they write nothing, unless their
 * own comment says so. Lists are a pointer and a count, and no list is kept after the call.
 */

#ifndef ZHUYI_H
#define ZHUYI_H

/* Made by cbindgen from crates/zhuyi-c/src: change it there. */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
 * What a call came to.
 */
enum zhuyi_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Done; what was asked for is written.
     */
    ZHUYI_STATUS_OK = 0,
    /**
     * A pointer is null that must not be.
     */
    ZHUYI_STATUS_NULL_POINTER = 1,
    /**
     * A list has no entries that needs at least one.
     */
    ZHUYI_STATUS_EMPTY = 2,
    /**
     * A number is NaN or infinite.
     */
    ZHUYI_STATUS_NOT_FINITE = 3,
    /**
     * A number is outside of its range, or a choice is none of its enum.
     */
    ZHUYI_STATUS_OUT_OF_RANGE = 4,
    /**
     * The times of a list go backwards; those of samples also must not stand still.
     */
    ZHUYI_STATUS_NOT_SORTED = 5,
    /**
     * A defect of the library, not of the call: please report it.
     */
    ZHUYI_STATUS_INTERNAL = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum zhuyi_status zhuyi_status;
#else
typedef uint32_t zhuyi_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What kind of answer an estimate is.
 */
enum zhuyi_state
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * No conflict in the horizon that braking could prevent.
     */
    ZHUYI_STATE_NONE = 0,
    /**
     * A latency of the grid is tolerable.
     */
    ZHUYI_STATE_TOLERABLE = 1,
    /**
     * No latency of the grid is, but to react at once would do: more than 30 FPR.
     */
    ZHUYI_STATE_BEYOND_GRID = 2,
    /**
     * Even to react at once is too late.
     */
    ZHUYI_STATE_UNAVOIDABLE = 3,
    /**
     * No latency of the grid is tolerable, and a conflict begins with the bodies side by side: no rate helps.
     */
    ZHUYI_STATE_ALONGSIDE = 4,
    /**
     * The ego stands where it is in conflict: no rate helps, and 1 FPR will do.
     */
    ZHUYI_STATE_STANDING = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum zhuyi_state zhuyi_state;
#else
typedef uint32_t zhuyi_state;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * What refuses the next larger latency.
 */
enum zhuyi_binding
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * There is none larger, or nothing speaks against it.
     */
    ZHUYI_BINDING_NONE = 0,
    /**
     * Eq. 1: never behind the actor while slow enough.
     */
    ZHUYI_BINDING_DISTANCE = 1,
    /**
     * Eq. 2: never slow enough.
     */
    ZHUYI_BINDING_SPEED = 2,
    /**
     * Both would hold at some time, but the ego drives through the actor before it.
     */
    ZHUYI_BINDING_PASS_THROUGH = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum zhuyi_binding zhuyi_binding;
#else
typedef uint32_t zhuyi_binding;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * The model with its parameters. It never changes: any number of threads may ask the same one at once.
 */
typedef struct zhuyi_estimator zhuyi_estimator;

/**
 * Everything the model can be told. Take zhuyi_params_default() and change what you must.
 */
typedef struct zhuyi_params {
    /**
     * [-] C1, share of the gap that may be used; in (0, 1].
     */
    double c1;
    /**
     * [-] C2, share of the actor's speed that the ego may have; in (0, 1].
     */
    double c2;
    /**
     * [m/s2] C3, least braking of the safety procedure; in (0, 20].
     */
    double c3;
    /**
     * [-] C4, factor on a braking already under way; in (0, 10].
     */
    double c4;
    /**
     * [s] how far ahead conflicts count; in [1, 100].
     */
    double horizon;
    /**
     * [m] lateral margin of the corridor; in [0, 3].
     */
    double lateral_margin;
    /**
     * [-] share of the probability for ZHUYI_AGGREGATION_PERCENTILE, not looked at otherwise; in (0, 1].
     */
    double percentile;
    /**
     * K, frames that confirm an actor; in [1, 1000].
     */
    uint32_t confirm_frames;
    /**
     * M, steps of the paper's search for t_n; in [1, 1000].
     */
    uint32_t max_steps;
    /**
     * The latencies tried, a zhuyi_grid.
     */
    uint32_t grid;
    /**
     * The search for t_n, a zhuyi_solver.
     */
    uint32_t solver;
    /**
     * What counts as safe, a zhuyi_criterion.
     */
    uint32_t criterion;
    /**
     * Several trajectories into one, a zhuyi_aggregation.
     */
    uint32_t aggregation;
    /**
     * 1 if a latency is to count as tolerable only where all smaller ones are too, else 0.
     */
    uint32_t cautious;
} zhuyi_params;

/**
 * One instant of an actor's future.
 */
typedef struct zhuyi_sample {
    /**
     * [s] when.
     */
    double time;
    /**
     * [m] centre of the box along the road.
     */
    double s;
    /**
     * [m] centre of the box across the road, positive to the left.
     */
    double d;
    /**
     * [m/s] speed along the road.
     */
    double v;
} zhuyi_sample;

/**
 * Motion along the road from `time` until the next piece starts; with x = t - time: s + s_rate x + s_half_accel x^2,
 * speed v + v_rate x.
 */
typedef struct zhuyi_along {
    /**
     * [s] start of the piece.
     */
    double time;
    /**
     * [m] centre of the box at its start.
     */
    double s;
    /**
     * [m/s] linear coefficient of s.
     */
    double s_rate;
    /**
     * [m/s2] quadratic coefficient of s, half an acceleration.
     */
    double s_half_accel;
    /**
     * [m/s] speed along the road at its start.
     */
    double v;
    /**
     * [m/s2] rate of change of that speed.
     */
    double v_rate;
} zhuyi_along;

/**
 * Motion across the road from `time` until the next piece starts.
 */
typedef struct zhuyi_across {
    /**
     * [s] start of the piece.
     */
    double time;
    /**
     * [m] lateral offset of the centre of the box at its start, positive to the left.
     */
    double d;
    /**
     * [m/s] its rate of change.
     */
    double d_rate;
} zhuyi_across;

/**
 * Half extents along and across the road of a box as it stands, from `time` until the next piece starts. Of a box turned
 * by an angle against the road they are (length |cos| + width |sin|) / 2 and (length |sin| + width |cos|) / 2.
 */
typedef struct zhuyi_extent {
    /**
     * [s] start of the piece.
     */
    double time;
    /**
     * [m] half extent along the road at its start; above 0.
     */
    double along;
    /**
     * [m/s] its rate of change.
     */
    double along_rate;
    /**
     * [m] half extent across the road at its start; above 0.
     */
    double across;
    /**
     * [m/s] its rate of change.
     */
    double across_rate;
} zhuyi_extent;

/**
 * One future of one actor, in pieces. Each list is sorted by time; its first piece also holds before its start, its last
 * one goes on for ever. The lists stay the caller's.
 */
typedef struct zhuyi_trajectory {
    /**
     * Motion along the road.
     */
    const struct zhuyi_along *along;
    /**
     * Pieces along the road; at least 1.
     */
    size_t along_count;
    /**
     * Motion across the road.
     */
    const struct zhuyi_across *across;
    /**
     * Pieces across the road; at least 1.
     */
    size_t across_count;
    /**
     * [s] time from which on the future is extrapolated rather than predicted.
     */
    double known_until;
    /**
     * Half extents of the box as it stands; null where it keeps aligned with the road.
     */
    const struct zhuyi_extent *extents;
    /**
     * Pieces of the half extents; 0 where it keeps aligned with the road.
     */
    size_t extent_count;
} zhuyi_trajectory;

/**
 * The box of a vehicle seen from above, centred on its reference point.
 */
typedef struct zhuyi_footprint {
    /**
     * [m] bumper to bumper; above 0.
     */
    double length;
    /**
     * [m] side to side; above 0.
     */
    double width;
} zhuyi_footprint;

/**
 * The ego at t_0, on the road or in any straight frame.
 */
typedef struct zhuyi_ego {
    /**
     * [m] centre of its box along the path.
     */
    double s;
    /**
     * [m] centre of its box across the path, positive to the left.
     */
    double d;
    /**
     * [m/s] speed; below 0 it counts as standing.
     */
    double speed;
    /**
     * [m/s2] acceleration, signed.
     */
    double accel;
    /**
     * Its box as it stands: its extents along and across the path, as of a zhuyi_extent twice over where it is turned.
     */
    struct zhuyi_footprint footprint;
} zhuyi_ego;

/**
 * The answer for one actor.
 */
typedef struct zhuyi_estimate {
    /**
     * [s] the tolerable latency; the largest of the grid where there is no conflict or the ego stands. NaN without
     * has_latency: nothing is tolerable.
     */
    double latency;
    /**
     * [Hz] the frame processing rate asked for, at most 30, and 30 where no latency of the grid will do. NaN
     * without has_fpr: an actor alongside, which no rate helps.
     */
    double fpr;
    /**
     * [s] the time t_n that made the latency tolerable, from t_0. NaN without has_t_n.
     */
    double t_n;
    /**
     * [s] how much of the horizon lies beyond what is known of the actor's future.
     */
    double extrapolated;
    /**
     * What kind of answer.
     */
    zhuyi_state state;
    /**
     * What refused the next larger latency of the grid.
     */
    zhuyi_binding binding;
    /**
     * Whether latency is there.
     */
    bool has_latency;
    /**
     * Whether fpr is there.
     */
    bool has_fpr;
    /**
     * Whether t_n is there.
     */
    bool has_t_n;
} zhuyi_estimate;

/**
 * One of several futures.
 */
typedef struct zhuyi_weighted_trajectory {
    /**
     * [-] its probability, or any number in proportion to it; above 0.
     */
    double weight;
    /**
     * The future.
     */
    struct zhuyi_trajectory trajectory;
} zhuyi_weighted_trajectory;

/**
 * The possible futures of one actor. The list stays the caller's.
 */
typedef struct zhuyi_forecast {
    /**
     * The actor's box.
     */
    struct zhuyi_footprint footprint;
    /**
     * The futures.
     */
    const struct zhuyi_weighted_trajectory *trajectories;
    /**
     * How many; at least 1.
     */
    size_t trajectory_count;
} zhuyi_forecast;

/**
 * The answer for an actor with several futures.
 */
typedef struct zhuyi_forecast_estimate {
    /**
     * The answer. Under ZHUYI_AGGREGATION_MEAN its latency lies between those of the grid, and all else is that of
     * the worst future.
     */
    struct zhuyi_estimate estimate;
    /**
     * The future that decided: its place in the forecast, from 0.
     */
    size_t trajectory;
} zhuyi_forecast_estimate;

/**
 * A position and heading in the world frame.
 */
typedef struct zhuyi_pose {
    /**
     * [m] x.
     */
    double x;
    /**
     * [m] y.
     */
    double y;
    /**
     * [rad] heading, counter-clockwise from the x axis.
     */
    double heading;
} zhuyi_pose;

/**
 * A camera on the ego and the latency at which it runs now.
 */
typedef struct zhuyi_camera {
    /**
     * [m] mount ahead of the centre of the ego's box.
     */
    double forward;
    /**
     * [m] mount to the left of the centre of the ego's box.
     */
    double left;
    /**
     * [rad] where it looks, counter-clockwise from straight ahead.
     */
    double yaw;
    /**
     * [rad] full horizontal field of view; in (0, 2 pi].
     */
    double fov;
    /**
     * [m] how far it sees; above 0.
     */
    double range;
    /**
     * [s] l_0, the latency at which it runs now; above 0.
     */
    double current_latency;
} zhuyi_camera;

/**
 * An actor: where it is, for the cameras, and where it may go, for the estimate.
 */
typedef struct zhuyi_actor {
    /**
     * Centre and heading of its box in the world, at t_0.
     */
    struct zhuyi_pose pose;
    /**
     * Its box and its futures.
     */
    struct zhuyi_forecast forecast;
} zhuyi_actor;

/**
 * What the actors ask of one camera.
 */
typedef struct zhuyi_demand {
    /**
     * [s] tolerable latency of the camera; the smallest of the grid where even that is too slow.
     */
    double latency;
    /**
     * [Hz] the frame processing rate asked for.
     */
    double fpr;
    /**
     * The actor that asks for it, its place in the list from 0: the first of the most demanding. 0 without
     * has_actor.
     */
    size_t actor;
    /**
     * Actors that ask for more than the grid offers.
     */
    uint32_t beyond_grid;
    /**
     * Actors for which even braking at once is too late.
     */
    uint32_t unavoidable;
    /**
     * Actors alongside, which no rate helps.
     */
    uint32_t alongside;
    /**
     * Actors in conflict with an ego that stands, which no rate helps.
     */
    uint32_t standing;
    /**
     * Whether any actor asks for anything.
     */
    bool has_actor;
} zhuyi_demand;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The version of the library, such as "0.1.0".
 */
const char *zhuyi_version(void);

/**
 * A sentence about a zhuyi_status, in English, for logs. Never null; it lives as long as the library.
 */
const char *zhuyi_status_message(uint32_t status);

/**
 * The paper's parameters.
 */
struct zhuyi_params zhuyi_params_default(void);

/**
 * A new estimator into *out, to be given back to zhuyi_estimator_free(). On failure *out is null.
 *
 * # Safety
 * Pointers are null or point to what they say.
 */
zhuyi_status zhuyi_estimator_new(const struct zhuyi_params *params, struct zhuyi_estimator **out);

/**
 * Gives an estimator back; null is allowed. Nobody may use it any more, and nobody may be using it.
 *
 * # Safety
 * The estimator is null or from zhuyi_estimator_new(), and not given back before.
 */
void zhuyi_estimator_free(struct zhuyi_estimator *estimator);

/**
 * A trajectory from samples, into *out: between two samples s, d and v are each interpolated linearly, past the
 * last one the actor keeps its speed and offset. Times must increase. The pieces are written to along and across,
 * which have room for sample_count entries each, lie apart from each other and from the samples, and must live as
 * long as *out is used. The box is aligned with the road; for one that is not set extents and extent_count of *out.
 * Allocates nothing.
 *
 * # Safety
 * Pointers are null or point to what they say.
 */
zhuyi_status zhuyi_trajectory_from_samples(const struct zhuyi_sample *samples,
                                           size_t sample_count,
                                           struct zhuyi_along *along,
                                           struct zhuyi_across *across,
                                           struct zhuyi_trajectory *out);

/**
 * The tolerable latency of one actor with the box *actor on one trajectory. now [s] is t_0 on the clock of the
 * trajectory; current_latency [s] is l_0, the latency at which the camera runs now, above 0. Allocates nothing.
 *
 * # Safety
 * Pointers are null or point to what they say.
 */
zhuyi_status zhuyi_estimate_trajectory(const struct zhuyi_estimator *estimator,
                                       const struct zhuyi_ego *ego,
                                       const struct zhuyi_footprint *actor,
                                       const struct zhuyi_trajectory *trajectory,
                                       double now,
                                       double current_latency,
                                       struct zhuyi_estimate *out);

/**
 * The tolerable latency of one actor over all its futures, aggregated as the estimator was told. now [s] is t_0 on
 * the clock of the forecast; current_latency [s] is l_0, above 0. Allocates a copy of the lists during the call.
 *
 * # Safety
 * Pointers are null or point to what they say.
 */
zhuyi_status zhuyi_estimate_forecast(const struct zhuyi_estimator *estimator,
                                     const struct zhuyi_ego *ego,
                                     const struct zhuyi_forecast *forecast,
                                     double now,
                                     double current_latency,
                                     struct zhuyi_forecast_estimate *out);

/**
 * The demand on each camera of a rig, into the camera_count entries of out. An actor counts for every camera that
 * has some of its box in its field of view and range at t_0. *ego is the ego on the road, *ego_pose the same
 * in the world, where the poses of the actors are. now [s] is t_0 on the clock of the forecasts. There may be no
 * actors, but there must be a camera. Allocates a copy of the lists during the call.
 *
 * # Safety
 * Pointers are null or point to what they say.
 */
zhuyi_status zhuyi_demands(const struct zhuyi_estimator *estimator,
                           const struct zhuyi_ego *ego,
                           const struct zhuyi_pose *ego_pose,
                           const struct zhuyi_camera *cameras,
                           size_t camera_count,
                           const struct zhuyi_actor *actors,
                           size_t actor_count,
                           double now,
                           struct zhuyi_demand *out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ZHUYI_H */
