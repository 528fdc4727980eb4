!> A wedge that falls into water: this program has the mass and the time loop, splashdown has the water.
!>
!>     drop            by the module splashdown
!>     drop legacy     by BOR, DIM, GEST, CAL
!>
!> Prints time [s], height [m], velocity [m/s] and force [N/m] of each step. At step 40 it tries a step with a wrong velocity
!> and takes it back: the later steps are the same as without.
program drop
  use, intrinsic :: iso_c_binding
  use splashdown
  use legacy_names
  implicit none
  character(len=23), parameter :: settings(2) = [character(len=23) :: "resolution.spacing=0.01", "time.end=0.02"]
  real(c_double), parameter :: mass = 100.0_c_double, gravity = 9.81_c_double, dt = 1e-4_c_double ! kg/m, m/s2, s
  character(len=8) :: names
  call get_command_argument(1, names)
  if (names == "legacy") then
    call by_legacy_names()
  else
    call by_the_module()
  end if

contains

  subroutine by_the_module()
    type(splashdown_scene) :: scene
    type(splashdown_element) :: water
    type(splashdown_host_nodes) :: nodes, wrong
    real(c_double) :: force(3, 1), unused(3, 1), time
    integer :: step

    call splashdown_open("wedge", settings, SPLASHDOWN_BODY, scene)
    call splashdown_scene_nodes(scene, nodes)
    call splashdown_build(scene, nodes, water)
    force = 0.0_c_double
    do step = 0, 99
      if (step == 40) then
        wrong = nodes
        wrong%velocity = 0.0_c_double
        call splashdown_save(water)
        call splashdown_contribute(water, dt, wrong, unused)
        call splashdown_restore(water)
      end if
      call fall(nodes, force(2, 1))
      call splashdown_contribute(water, dt, nodes, force)
      call splashdown_time(water, time)
      call put(time, nodes, force)
    end do
    call splashdown_finish(water)
  end subroutine

  subroutine by_legacy_names()
    type(sph_element) :: e
    type(splashdown_host_nodes) :: nodes, wrong
    real(c_double) :: force(3, 1), unused(3, 1), time
    integer(c_int64_t) :: bytes
    integer :: step, ierr, n, fluid, walls
    character(len=1000) :: text

    call bor(e, "wedge", settings, SPLASHDOWN_BODY, ierr, text)
    call check(ierr, text)
    call dim(e, n, fluid, walls, bytes, ierr, text)
    call check(ierr, text)
    call gest(e, nodes, ierr, text)
    call check(ierr, text)
    force = 0.0_c_double
    do step = 0, 99
      if (step == 40) then
        wrong = nodes
        wrong%velocity = 0.0_c_double
        call splashdown_save(e%water)
        call cal(e, dt, wrong, unused, ierr, text)
        call check(ierr, text)
        call splashdown_restore(e%water)
      end if
      call fall(nodes, force(2, 1))
      call cal(e, dt, nodes, force, ierr, text)
      call check(ierr, text)
      call splashdown_time(e%water, time)
      call put(time, nodes, force)
    end do
    call splashdown_finish(e%water)
  end subroutine

  !> Newton's law in y under the force of the last step [N/m].
  subroutine fall(nodes, force)
    type(splashdown_host_nodes), intent(inout) :: nodes
    real(c_double), intent(in) :: force
    real(c_double) :: old
    old = nodes%velocity(2, 1)
    nodes%velocity(2, 1) = old + dt*(force/mass - gravity)
    nodes%position(2, 1) = nodes%position(2, 1) + dt*(0.5_c_double*(old + nodes%velocity(2, 1)))
  end subroutine

  subroutine put(time, nodes, force)
    real(c_double), intent(in) :: time, force(3, 1)
    type(splashdown_host_nodes), intent(in) :: nodes
    print "(4(es24.16e3, 1x))", time, nodes%position(2, 1), nodes%velocity(2, 1), force(2, 1)
  end subroutine

  subroutine check(ierr, text)
    integer, intent(in) :: ierr
    character(len=*), intent(in) :: text
    if (ierr /= 0) error stop trim(text)
  end subroutine
end program
