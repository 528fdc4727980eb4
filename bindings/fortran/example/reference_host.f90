!> The reference host: a landing-dynamics program with water under it. It is
!> scenarios/examples/reference_host.rs in Fortran. Both print the same bits: their sums and products have the same order.
!>
!>     reference_host SCENE     with scenarios/examples/reference_section.toml
!>
!> A fuselage section comes down at 3 m/s: a frame, a cabin on an oleo, and a flexible belly of nine nodes. The host integrates
!> them by velocity Verlet. It predicts each step with the water's last force; where the force came out too different it
!> rejects the step and repeats it with the better force.
!>
!> Per metre of span, SI units. Each line: time, height of frame and cabin, deflection and velocity of the keel, force of the
!> water, force of the oleo. At the end: steps, rejected steps.
program reference_host
  use, intrinsic :: iso_c_binding
  use splashdown
  implicit none

  !> Nodes of the belly, unknowns of the host, steps.
  integer, parameter :: belly = 9, unknowns = 2 + belly, steps = 400
  !> Distance of the belly's nodes along x [m]; bending stiffness [N m] and mass of a node of the belly [kg/m].
  real(c_double), parameter :: h = 0.1_c_double, stiffness = 6.0e3_c_double, node = 4.0_c_double
  !> Masses of frame and cabin [kg/m]; spring [N/m2] and damper [N s2/m3] of the oleo; gravity [m/s2].
  real(c_double), parameter :: frame = 250.0_c_double, cabin = 500.0_c_double, spring = 5.0e5_c_double, &
                               damper = 4.0e4_c_double, gravity = 9.81_c_double
  !> Step of the host [s], and the change of velocity from which a step is rejected [m/s].
  real(c_double), parameter :: dt = 5.0e-5_c_double, tolerance = 0.002_c_double

  !> Heights of frame (1) and cabin (2), deflections of the belly against the frame [m]; and their velocities [m/s].
  type :: state
    real(c_double) :: x(unknowns) = 0.0_c_double, v(unknowns) = 0.0_c_double
  end type

  type(splashdown_scene) :: scene
  type(splashdown_element) :: water
  type(splashdown_host_nodes) :: start, nodes
  type(state) :: now, next
  real(c_double), allocatable :: forces(:, :)
  real(c_double) :: predicted(belly), found(belly), time, total
  integer :: step, k, rejected
  logical :: redone
  character(len=1000) :: path
  character(len=0) :: none(0)

  call get_command_argument(1, path)
  if (path == "") path = "scenarios/examples/reference_section.toml"
  call splashdown_open(path, none, SPLASHDOWN_NODES, scene)
  call splashdown_scene_nodes(scene, start)
  call splashdown_build(scene, start, water)
  nodes = start
  allocate (forces(3, size(start%position, 2)))
  now%v(1:2) = start%velocity(2, 1)
  predicted = 0.0_c_double
  rejected = 0
  do step = 1, steps
    call splashdown_save(water)
    redone = .false.
    do
      next = verlet(now, predicted)
      do k = 1, size(nodes%position, 2)
        nodes%position(2, k) = start%position(2, k) + next%x(1)
        nodes%velocity(2, k) = next%v(1)
        if (k > belly) cycle
        nodes%position(2, k) = nodes%position(2, k) + next%x(2 + k)
        nodes%velocity(2, k) = nodes%velocity(2, k) + next%v(2 + k)
      end do
      call splashdown_contribute(water, dt, nodes, forces)
      found = forces(2, 1:belly)
      if (redone .or. maxval(dt*abs(found - predicted)/node) <= tolerance) exit
      call splashdown_restore(water)
      predicted = found
      redone = .true.
      rejected = rejected + 1
    end do
    ! the nodes stay where they were predicted; their velocities take the impulse of the water
    next%v = next%v + dt*(accelerations(next, found) - accelerations(next, predicted))
    now = next
    predicted = found
    if (mod(step, 20) == 0) then
      total = 0.0_c_double
      do k = 1, size(forces, 2)
        total = total + forces(2, k)
      end do
      call splashdown_time(water, time)
      print "(7(es24.16e3, 1x))", time, now%x(1), now%x(2), now%x(7), now%v(7), total, oleo(now)
    end if
  end do
  print "(i0, a, i0, a)", steps, " steps, ", rejected, " rejected"
  call splashdown_finish(water)
  deallocate (forces)

contains

  pure function oleo(s) result(force)
    type(state), intent(in) :: s
    real(c_double) :: force, closing, speed
    closing = s%x(1) - s%x(2)
    speed = s%v(1) - s%v(2)
    force = spring*closing + damper*speed*abs(speed)
  end function

  !> Accelerations [m/s2] under the water's forces on the belly [N/m].
  pure function accelerations(s, water) result(a)
    type(state), intent(in) :: s
    real(c_double), intent(in) :: water(belly)
    real(c_double) :: a(unknowns), w(belly), moment(0:belly + 1), force(belly), strut
    integer :: i
    w = s%x(3:)
    moment = 0.0_c_double
    do i = 2, belly - 1
      moment(i) = stiffness*(w(i - 1) - 2.0_c_double*w(i) + w(i + 1))/(h*h)
    end do
    do i = 1, belly
      force(i) = water(i) - (moment(i - 1) - 2.0_c_double*moment(i) + moment(i + 1))/h
    end do
    strut = oleo(s)
    a = 0.0_c_double
    a(1) = (force(1) + force(belly) - strut)/frame - gravity
    a(2) = strut/cabin - gravity
    do i = 2, belly - 1
      a(2 + i) = force(i)/node - gravity - a(1)
    end do
  end function

  !> The state after a step under forces of the water that are predicted.
  pure function verlet(s, water) result(after)
    type(state), intent(in) :: s
    real(c_double), intent(in) :: water(belly)
    type(state) :: after
    real(c_double) :: before(unknowns)
    before = accelerations(s, water)
    after = s
    after%x = s%x + dt*s%v + 0.5_c_double*dt*dt*before
    after%v = s%v + 0.5_c_double*dt*(before + accelerations(after, water))
  end function
end program
