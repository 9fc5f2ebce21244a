/* The ego drives 20 m/s. 40 m ahead a car of the same speed brakes until it stands; another one passes on the left,
 * cuts in and slows down. How late may the ego react, and how often must each camera's frames be processed? */
#include <stdio.h>
#include <zhuyi.h>

static int failed(zhuyi_status status) {
    if (status != ZHUYI_STATUS_OK) fprintf(stderr, "zhuyi: %s\n", zhuyi_status_message(status));
    return status != ZHUYI_STATUS_OK;
}

int main(void) {
    const zhuyi_footprint car = {4.5, 1.8};
    const zhuyi_ego ego = {0.0, 0.0, 20.0, 0.0, car}; /* s, d, speed, acceleration */
    const double now = 0.0, current_latency = 1.0 / 30.0;

    /* Ahead: from 44.5 m at 20 m/s with -8 m/s2; after 2.5 s and 25 m it stands. */
    const zhuyi_along brakes[] = {{0.0, 44.5, 20.0, -4.0, 20.0, -8.0}, {2.5, 69.5, 0.0, 0.0, 0.0, 0.0}};
    const zhuyi_across keeps_lane[] = {{0.0, 0.0, 0.0}};
    const zhuyi_trajectory ahead = {brakes, 2, keeps_lane, 1, 20.0, NULL, 0}; /* aligned */

    /* Left: three samples (t, s, d, v) of a car that passes, slows down and moves into the ego's lane. */
    const zhuyi_sample samples[] = {{0.0, 1.0, 3.5, 26.0}, {2.0, 49.0, 3.5, 22.0}, {4.0, 85.0, 0.0, 14.0}};
    zhuyi_along along[3];
    zhuyi_across across[3];
    zhuyi_trajectory left;
    if (failed(zhuyi_trajectory_from_samples(samples, 3, along, across, &left))) return 1;

    const zhuyi_params params = zhuyi_params_default();
    zhuyi_estimator *estimator;
    if (failed(zhuyi_estimator_new(&params, &estimator))) return 1;

    zhuyi_estimate answer;
    if (failed(zhuyi_estimate_trajectory(estimator, &ego, &car, &ahead, now, current_latency, &answer))) return 1;
    printf("ahead: state %d, latency %.17g s, %.17g Hz\n", (int)answer.state, answer.latency, answer.fpr);

    const zhuyi_weighted_trajectory futures[] = {{1.0, ahead}, {1.0, left}};
    const zhuyi_actor actors[] = {{{44.5, 0.0, 0.0}, {car, &futures[0], 1}}, {{1.0, 3.5, 0.0}, {car, &futures[1], 1}}};
    const zhuyi_camera rig[] = {
        {1.8, 0.0, 0.0, 2.0, 150.0, current_latency},  /* front: forward, left, yaw, field of view, range, l_0 */
        {0.5, 0.9, 1.57, 2.0, 80.0, current_latency},  /* left */
        {-2.0, 0.0, 3.1, 2.0, 80.0, current_latency}, /* rear */
    };
    const zhuyi_pose pose = {0.0, 0.0, 0.0}; /* the road is the x axis */
    zhuyi_demand demands[3];
    if (failed(zhuyi_demands(estimator, &ego, &pose, rig, 3, actors, 2, now, demands))) return 1;
    for (int camera = 0; camera < 3; camera++) {
        printf("camera %d: %.17g s, %.17g Hz\n", camera, demands[camera].latency, demands[camera].fpr);
    }
    zhuyi_estimator_free(estimator);
    return 0;
}
