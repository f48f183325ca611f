(* SPDX-License-Identifier: MIT *)
(* Rotations by quaternions of any length, in exact reals,
  and the heart of the proof: a quaternion that is off by a share
   eps of its length turns a vector at most 2 eps of the vector's length away (rot_near). *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Record V3 := v3 { vx : R; vy : R; vz : R }.
Record Q4 := q4 { qw : R; qx : R; qy : R; qz : R }.
Definition vadd a b := v3 (vx a + vx b) (vy a + vy b) (vz a + vz b).
Definition vsub a b := v3 (vx a - vx b) (vy a - vy b) (vz a - vz b).
Definition vscale k a := v3 (k * vx a) (k * vy a) (k * vz a).
Definition v2n a := vx a * vx a + vy a * vy a + vz a * vz a.
Definition vnorm a := sqrt (v2n a).
Definition q2n q := qw q * qw q + qx q * qx q + qy q * qy q + qz q * qz q.
Definition qnorm q := sqrt (q2n q).
Definition qsub a b := q4 (qw a - qw b) (qx a - qx b) (qy a - qy b) (qz a - qz b).
Definition qscale k a := q4 (k * qw a) (k * qx a) (k * qy a) (k * qz a).
Definition qmul a b := q4
  (qw a * qw b - qx a * qx b - qy a * qy b - qz a * qz b)
  (qw a * qx b + qx a * qw b + qy a * qz b - qz a * qy b)
  (qw a * qy b - qx a * qz b + qy a * qw b + qz a * qx b)
  (qw a * qz b + qx a * qy b - qy a * qx b + qz a * qw b).
Definition qconj a := q4 (qw a) (- qx a) (- qy a) (- qz a).
(* q v ~q, not divided *)
Definition sand q v := v3
  ((qw q*qw q + qx q*qx q - qy q*qy q - qz q*qz q) * vx v + 2*(qx q*qy q - qw q*qz q) * vy v + 2*(qx q*qz q + qw q*qy
    q) * vz v)
  (2*(qx q*qy q + qw q*qz q) * vx v + (qw q*qw q - qx q*qx q + qy q*qy q - qz q*qz q) * vy v + 2*(qy q*qz q - qw q*qx
    q) * vz v)
  (2*(qx q*qz q - qw q*qy q) * vx v + 2*(qy q*qz q + qw q*qx q) * vy v + (qw q*qw q - qx q*qx q - qy q*qy q + qz q*qz
    q) * vz v).
Definition rot q v := vscale (/ q2n q) (sand q v).

Ltac comp := repeat match goal with v : V3 |- _ => destruct v | q : Q4 |- _ => destruct q end;
  unfold rot, sand, qmul, qconj, qsub, qscale, q2n, v2n, vadd, vsub, vscale in *; simpl in *.

Lemma v2n_pos v : 0 <= v2n v. Proof. comp; nra. Qed.
Lemma q2n_pos q : 0 <= q2n q. Proof. comp; nra. Qed.
Lemma sand_mul a b v : sand (qmul a b) v = sand a (sand b v).
Proof. comp; f_equal; ring. Qed.
Lemma q2n_mul a b : q2n (qmul a b) = q2n a * q2n b. Proof. comp; ring. Qed.
Lemma v2n_sand q v : v2n (sand q v) = q2n q * q2n q * v2n v. Proof. comp; ring. Qed.
Lemma v2n_scale k v : v2n (vscale k v) = k * k * v2n v. Proof. comp; ring. Qed.
Lemma sand_sub q a b : sand q (vsub a b) = vsub (sand q a) (sand q b). Proof. comp; f_equal; ring. Qed.
Lemma vscale_sub k a b : vscale k (vsub a b) = vsub (vscale k a) (vscale k b). Proof. comp; f_equal; ring. Qed.
Lemma rot_sub q a b : rot q (vsub a b) = vsub (rot q a) (rot q b).
Proof. unfold rot. now rewrite sand_sub, vscale_sub. Qed.
Lemma rot_norm q v : 0 < q2n q -> vnorm (rot q v) = vnorm v.
Proof. intro H. unfold vnorm, rot. f_equal. rewrite v2n_scale, v2n_sand. field. lra. Qed.
Lemma sand_scale q k v : sand q (vscale k v) = vscale k (sand q v). Proof. comp; f_equal; ring. Qed.
Lemma rot_scale q k v : rot q (vscale k v) = vscale k (rot q v).
Proof. unfold rot. rewrite sand_scale. comp; f_equal; ring. Qed.
Lemma rot_mul a b v : 0 < q2n a -> 0 < q2n b -> rot (qmul a b) v = rot a (rot b v).
Proof. intros. unfold rot. rewrite sand_mul, q2n_mul, sand_scale. destruct (sand a (sand b v)).
  unfold vscale; simpl. f_equal; field; lra. Qed.
Lemma rot_qscale k q v : k <> 0 -> 0 < q2n q -> rot (qscale k q) v = rot q v.
Proof. intros Hk H. assert (E : q2n (qscale k q) = k * k * q2n q) by (comp; ring).
  assert (S : sand (qscale k q) v = vscale (k * k) (sand q v)) by (comp; f_equal; ring).
  unfold rot. rewrite E, S. destruct (sand q v). unfold vscale; simpl. f_equal; field; lra. Qed.

(* Cauchy and Minkowski *)
Lemma vtri a b : vnorm (vadd a b) <= vnorm a + vnorm b.
Proof.
  unfold vnorm. pose proof (v2n_pos a) as Ha. pose proof (v2n_pos b) as Hb.
  apply Rsqr_incr_0_var. 2: { pose proof (sqrt_pos (v2n a)); pose proof (sqrt_pos (v2n b)); lra. }
  rewrite Rsqr_sqrt by apply v2n_pos. unfold Rsqr.
  replace ((sqrt (v2n a) + sqrt (v2n b)) * (sqrt (v2n a) + sqrt (v2n b)))
    with (sqrt (v2n a) * sqrt (v2n a) + sqrt (v2n b) * sqrt (v2n b) + 2 * (sqrt (v2n a) * sqrt (v2n b))) by ring.
  rewrite !sqrt_sqrt by assumption. rewrite <- sqrt_mult by assumption.
  assert (vx a * vx b + vy a * vy b + vz a * vz b <= sqrt (v2n a * v2n b)).
  { apply Rle_trans with (sqrt (Rsqr (vx a * vx b + vy a * vy b + vz a * vz b))).
    rewrite sqrt_Rsqr_abs. apply Rle_abs. apply sqrt_le_1_alt. unfold Rsqr. comp.
    pose proof (Rle_0_sqr (vx0*vy1 - vy0*vx1)). pose proof (Rle_0_sqr (vx0*vz1 - vz0*vx1)).
      pose proof (Rle_0_sqr (vy0*vz1-vz0*vy1)).
    unfold Rsqr in *. nra. }
  comp. nra.
Qed.
Lemma vsub_tri a b c : vnorm (vsub a c) <= vnorm (vsub a b) + vnorm (vsub b c).
Proof. replace (vsub a c) with (vadd (vsub a b) (vsub b c)). apply vtri. comp; f_equal; ring. Qed.
Lemma vnorm_scale k v : vnorm (vscale k v) = Rabs k * vnorm v.
Proof. unfold vnorm. rewrite v2n_scale, sqrt_mult by (try nra; apply v2n_pos). f_equal.
  change (k*k) with (Rsqr k). apply sqrt_Rsqr_abs. Qed.

(* the heart: |rot q' v - rot q v| <= 2 |q'-q|/|q| |v|, exactly, no second order *)
Lemma sand_one r x : v2n (vsub (sand r x) (vscale (q2n r) x)) <= 4 * q2n r * (q2n r - qw r * qw r) * v2n x.
Proof.
  assert (E : v2n (vsub (sand r x) (vscale (q2n r) x)) = 4 * q2n r *
    ((q2n r - qw r * qw r) * v2n x - (qx r * vx x + qy r * vy x + qz r * vz x) * (qx r * vx x + qy r * vy x + qz r * vz
      x)))
    by (comp; ring).
  rewrite E. pose proof (q2n_pos r).
  pose proof (Rle_0_sqr (qx r * vx x + qy r * vy x + qz r * vz x)) as S. unfold Rsqr in S. nra.
Qed.
Lemma rot_near2 q' q v : 0 < q2n q -> 0 < q2n q' ->
  v2n (vsub (rot q' v) (rot q v)) <= 4 * (q2n (qsub q' q) / q2n q) * v2n v.
Proof.
  intros H H'. set (r := qmul q' (qconj q)).
  assert (Hc : q2n (qconj q) = q2n q) by (comp; ring).
  assert (Hr : q2n r = q2n q' * q2n q) by (unfold r; rewrite q2n_mul, Hc; reflexivity).
  assert (Hrq : rot q' v = rot r (rot q v)).
  { unfold r. rewrite rot_mul by (rewrite ?Hc; assumption). f_equal.
    rewrite <- rot_mul by (rewrite ?Hc; assumption).
    assert (E : qmul (qconj q) q = q4 (q2n q) 0 0 0) by (comp; f_equal; ring).
    rewrite E. unfold rot, sand, vscale, q2n; simpl. destruct v; unfold q2n in H; simpl. f_equal; field; comp; nra. }
  rewrite Hrq. set (x := rot q v).
  assert (Hx : v2n x = v2n v).
  { unfold x, rot. rewrite v2n_scale, v2n_sand. field. lra. }
  assert (Hr0 : 0 < q2n r) by (rewrite Hr; nra).
  assert (E : vsub (rot r x) x = vscale (/ q2n r) (vsub (sand r x) (vscale (q2n r) x))).
  { unfold rot. destruct (sand r x), x. unfold vsub, vscale; simpl. f_equal; field; lra. }
  rewrite E, v2n_scale. pose proof (sand_one r x) as S. rewrite Hx in S.
  assert (D : q2n r - qw r * qw r <= q2n (qsub q' q) * q2n q').
  { unfold r. clear.
    set (d := qmul q' (qconj (qsub q q'))).
    assert (E1 : q2n (qmul q' (qconj q)) - qw (qmul q' (qconj q)) * qw (qmul q' (qconj q)) = q2n d - qw d * qw d) by
      (unfold d; comp; ring).
    assert (E2 : q2n d = q2n (qsub q' q) * q2n q') by (unfold d; comp; ring).
    rewrite E1, E2. pose proof (Rle_0_sqr (qw d)). unfold Rsqr in *. lra. }
  pose proof (v2n_pos v).
  apply Rle_trans with (/ q2n r * / q2n r * (4 * q2n r * (q2n (qsub q' q) * q2n q') * v2n v)).
  - apply Rmult_le_compat_l. { apply Rlt_le, Rmult_lt_0_compat; apply Rinv_0_lt_compat; lra. }
    apply Rle_trans with (1 := S). apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [lra|]. exact D.
  - rewrite Hr. right. field. lra.
Qed.
Lemma rot_near q' q v : 0 < q2n q -> 0 < q2n q' ->
  vnorm (vsub (rot q' v) (rot q v)) <= 2 * (qnorm (qsub q' q) / qnorm q) * vnorm v.
Proof.
  intros H H'. pose proof (rot_near2 q' q v H H') as B.
  unfold vnorm, qnorm. apply Rle_trans with (1 := sqrt_le_1_alt _ _ B).
  assert (0 <= q2n (qsub q' q) / q2n q). { apply Rmult_le_pos. apply q2n_pos. left. now apply Rinv_0_lt_compat. }
  rewrite sqrt_mult, sqrt_mult; try lra; try apply v2n_pos; try nra.
  replace (sqrt 4) with 2. 2: { replace 4 with (2*2) by lra. rewrite sqrt_square; lra. }
  rewrite sqrt_div_alt by assumption. lra.
Qed.
